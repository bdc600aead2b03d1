// A loader for checkers: reads mesh files as the server does, but builds no collision objects.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "server/scenario/compiler.hpp"

namespace mechane::content {
struct ImportedScene;
}

namespace mechane::scenario {

/// Imports each mesh file once, in the limited child process that the server uses, and looks names of nodes up in it. One thread; blocks
/// for as long as an import takes.
class MeshFinder final : public ObjectLoader {
 public:
  MeshFinder();
  ~MeshFinder() override;

  /// Returns null. Errors: the file cannot be imported (reported once per file); it has no such node (unknown_name, with the nearest);
  /// the node has nothing to touch.
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                        const std::string& node,
                                                                        const geometry::SolidChoice& solid) override;
  [[nodiscard]] Expected<void> find_node(const std::filesystem::path& file, const std::string& node) override;
  /// None where the file could not be imported, which has been reported.
  [[nodiscard]] Expected<std::optional<Solid>> solid(const std::filesystem::path& file,
                                                     const std::string& node) override;
  [[nodiscard]] bool has_meshes_at_hand() const override { return true; }
  [[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file) override;

 private:
  /// Null where the file could not be imported, which has been reported.
  Expected<const content::ImportedScene*> scene_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, std::unique_ptr<content::ImportedScene>> scenes_;
};

}  // namespace mechane::scenario
