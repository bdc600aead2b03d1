#include "server/scenario/mesh_finder.hpp"

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/content/mesh_import.hpp"
#include "server/x3d/problem.hpp"

namespace mechane::scenario {
namespace {

Expected<void> find_in(const content::ImportedScene& scene, const std::string& node) {
  if (content::find_node(scene, node)) return {};
  std::vector<std::string> names;
  for (const content::ImportedNode& other : scene.nodes) {
    // Parts of a body are not bodies, and some exporters leave nodes without a name.
    const bool piece = other.name.starts_with("part_") || other.name.starts_with("visual_");
    if (!other.name.empty() && !piece) names.push_back(other.name);
  }
  return fail(ErrorCode::unknown_name, "the mesh file has no node of that name", "node " + node,
              suggest(node, names, "give the object that name in the model, and export it again"));
}

}  // namespace

MeshFinder::MeshFinder() = default;
MeshFinder::~MeshFinder() = default;

Expected<const content::ImportedScene*> MeshFinder::scene_of(const std::filesystem::path& file) {
  const auto known = scenes_.find(file);
  if (known != scenes_.end()) return known->second.get();
  auto scene = content::import_mesh(file);
  auto& kept = scenes_[file];
  if (!scene) return tl::unexpected(std::move(scene.error()));
  kept = std::make_unique<content::ImportedScene>(std::move(*scene));
  return kept.get();
}

Expected<std::shared_ptr<const collision::Object>> MeshFinder::load(const std::filesystem::path& file,
                                                                    const std::string& node,
                                                                    const geometry::SolidChoice& /*solid*/) {
  if (auto found = find_node(file, node); !found) return tl::unexpected(std::move(found.error()));
  const auto scene = scene_of(file);
  if (scene && *scene != nullptr) {
    if (auto parts = content::collision_parts(**scene, node); !parts) return tl::unexpected(std::move(parts.error()));
  }
  return nullptr;
}

Expected<void> MeshFinder::find_node(const std::filesystem::path& file, const std::string& node) {
  const auto scene = scene_of(file);
  if (!scene) return tl::unexpected(scene.error());
  return *scene == nullptr ? Expected<void>() : find_in(**scene, node);
}

Expected<std::optional<Solid>> MeshFinder::solid(const std::filesystem::path& file, const std::string& node) {
  const auto scene = scene_of(file);
  if (!scene) return tl::unexpected(scene.error());
  if (*scene == nullptr) return std::nullopt;
  const auto parts = content::collision_parts(**scene, node);
  if (!parts) return tl::unexpected(parts.error());
  return solid_of(*parts);
}

Expected<std::string> MeshFinder::content_hash(const std::filesystem::path& file) {
  return hash_file(file);
}

}  // namespace mechane::scenario
