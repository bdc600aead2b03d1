// Appearances of X3D as materials and textures.
#pragma once

#include <map>
#include <tuple>

#include "server/base/error.hpp"
#include "server/content/imported_scene.hpp"
#include "server/content/importer/folder_io.hpp"
#include "server/x3d/document.hpp"

namespace mechane::content {

/// Fills a scene's materials and textures; each Appearance becomes one material, or two where it is seen on both sides and on one. Both
/// must outlive this.
class X3dLooks {
 public:
  X3dLooks(const FolderIo& io, ImportedScene& scene) : io_(io), scene_(scene) {}

  /// The index of the material; without an appearance, a Shape is plain white. Images are looked for in the document's
  /// folder. Errors: not_found (an image), not_supported (neither PNG nor JPEG), io_failure.
  [[nodiscard]] Expected<std::uint32_t> material(const x3d::Document& document, x3d::NodeId appearance,
                                                 bool both_sides);

 private:
  using Slot = std::optional<std::uint32_t>;
  Expected<void> read_material(const x3d::Document& document, x3d::NodeId id, ImportedMaterial& to);
  Expected<void> read_textures(const x3d::Document& document, x3d::NodeId appearance, ImportedMaterial& to);
  Expected<void> read_texture(const x3d::Document& document, x3d::NodeId id, Slot& to);

  const FolderIo& io_;
  ImportedScene& scene_;
  std::map<std::tuple<const x3d::Document*, x3d::NodeId, bool>, std::uint32_t> known_;
  std::map<std::string, std::uint32_t> textures_;  // by path
};

}  // namespace mechane::content
