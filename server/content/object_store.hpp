// Collision objects by model file and node. Fitting takes seconds for each part, so every object that was built is kept as a .part file,
// named after its geometry.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/collision_build/object_builder.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Raised when the builder makes other objects from the same meshes: the cache then builds them again.
inline constexpr int kObjectBuildVersion = 8;
/// Raised when the import makes other triangles of the same file. This is not kSceneCodecVersion: a new field of materials must not make a
/// museum wait for minutes.
inline constexpr int kObjectImportVersion = 1;

/// $XDG_CACHE_HOME/mechane, or ~/.cache/mechane, or a folder under the system's temporary one when there is no home.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// Not thread-safe, and never for a loop thread: it reads, runs the import and builds. The objects it gives may go anywhere.
class ObjectStore {
 public:
  /// Called when `parts` parts of the node are about to be built, which takes long. Not called for objects that the cache has.
  using Progress = std::function<void(const std::string& node, std::size_t parts)>;

  /// An empty `cache_folder` means default_cache_folder(). The folder is made with the first object that is kept.
  explicit ObjectStore(std::filesystem::path cache_folder = {}, ImportLimits limits = {});

  void on_progress(Progress progress) { progress_ = std::move(progress); }

  /// The object of the parts under `node` (of the whole file when empty; see collision_parts), in the node's frame: from the cache,
  /// or imported, built and kept. The cache's key is the geometry of the parts with their names, the config and the formats' versions, so
  /// that an outdated object is never found, and a change of colours builds nothing again. The object of a damaged cache file is built
  /// again; a cache that cannot be written only costs time. Both are logged.
  /// Errors: those of import_mesh, collision_parts and build_object.
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                        const std::string& node,
                                                                        const collision_build::BuildConfig& config);

  /// The file in which load() keeps this object. Imports the model where the cache does not have its geometry's hash yet.
  [[nodiscard]] Expected<std::filesystem::path> cache_file(const std::filesystem::path& file, const std::string& node,
                                                           const collision_build::BuildConfig& config);

 private:
  struct LastImport {
    std::string content_hash;
    ImportedScene scene;
  };
  [[nodiscard]] Expected<collision::Object> build(const std::filesystem::path& file, const std::string& node,
                                                  const collision_build::BuildConfig& config);
  /// The hash of the parts' geometry. It is kept in the cache by the model's content, so that a start without changes imports nothing.
  [[nodiscard]] Expected<std::string> geometry_of(const std::filesystem::path& file, const std::string& node);
  [[nodiscard]] Expected<std::vector<geometry::NamedMesh>> parts_of(const std::filesystem::path& file,
                                                                    const std::string& node);
  [[nodiscard]] Expected<const ImportedScene*> scene_of(const std::filesystem::path& file);

  std::filesystem::path cache_folder_;
  ImportLimits limits_;
  Progress progress_;
  std::optional<LastImport> last_import_;  ///< the bodies of a scenario are mostly nodes of one file
  std::map<std::filesystem::path, std::weak_ptr<const collision::Object>> known_;  ///< by cache file
};

}  // namespace mechane::content
