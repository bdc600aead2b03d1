#include "client-sdk/gateway/browsers/known_content.hpp"

namespace mechane::gateway {

void KnownContent::hear(const client::WorldStatus& status, std::span<const client::SceneObject> objects) {
  if (status.scenario_folder.empty()) return;
  if (exhibits_.size() < kMostExhibits || exhibits_.contains(status.scenario))
    exhibits_[status.scenario] = status.scenario_folder;
  for (const client::SceneObject& object : objects) {
    if (object.mesh_hash.empty() || object.mesh_uri.empty()) continue;
    // A mesh may lie beside the exhibit's folder: the manifest names it, and its hash is checked before it is sent.
    const auto file = (std::filesystem::path(status.scenario_folder) / object.mesh_uri).lexically_normal();
    if (meshes_.size() < kMostMeshes || meshes_.contains(object.mesh_hash))
      meshes_[object.mesh_hash] = {file.parent_path(), file.filename().string()};
  }
}

std::optional<KnownContent::Mesh> KnownContent::mesh(const std::string& hash) const {
  const auto found = meshes_.find(hash);
  if (found == meshes_.end()) return std::nullopt;
  return found->second;
}

std::optional<std::filesystem::path> KnownContent::exhibit(const std::string& scenario) const {
  const auto found = exhibits_.find(scenario);
  if (found == exhibits_.end()) return std::nullopt;
  return found->second;
}

}  // namespace mechane::gateway
