#include "tests/benchmark/collision/models.hpp"

#include <algorithm>

#include "server/collision_build/object_builder.hpp"
#include "server/collision_build/part_source.hpp"
#include "server/content/mesh_import.hpp"
#include "server/geometry/mesh_check.hpp"

namespace mechane::benchmark {
namespace {

constexpr double kHeld_m = 0.2;  // the diagonal of a thing without a unit

/// A body is the node right above its parts.
bool is_body(const content::ImportedScene& scene, std::uint32_t node) {
  return std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const content::ImportedNode& child) {
    return child.parent == node && child.name.starts_with("part_");
  });
}

/// What `mechane fit` would be given, with our builder's own budget.
SceneObject object_of(const std::string& name, std::vector<geometry::NamedMesh> parts, bool as_given, double finest_m) {
  const collision_build::BuildConfig ours;
  std::vector<geometry::Mesh> welded;
  geometry::Mesh whole;
  for (const geometry::NamedMesh& part : parts) {
    welded.push_back(geometry::weld(part.mesh));
    whole.append(welded.back());
  }
  SceneObject object = make_scene_object(name, std::move(whole), Pose{});
  if (parts.size() > 1) {
    const collision_build::Solid solid(welded, ours.seam_gap_m);
    object.skin_O = finest_m > 0 ? collision_build::cut_air_side(welded, solid, finest_m)
                                 : collision_build::air_side(welded, solid);
  }
  if (as_given) object.parts_O = std::move(parts);
  object.max_error_m = ours.max_error_m;
  object.probe_depth_m = ours.probe_depth_m;
  return object;
}

}  // namespace

Expected<std::vector<SceneObject>> load_models(const std::filesystem::path& file, double finest_m) {
  const auto scene = content::import_mesh(file);
  if (!scene) return tl::unexpected(scene.error());
  const std::string stem = file.stem().string();
  std::vector<SceneObject> objects;
  for (std::uint32_t i = 0; i < scene->nodes.size(); ++i) {
    const content::ImportedNode& node = scene->nodes[i];
    if (!is_body(*scene, i)) continue;
    auto parts = content::collision_parts(*scene, node.name);
    if (!parts) return tl::unexpected(parts.error());
    objects.push_back(object_of(stem + "-" + node.name, std::move(*parts), true, finest_m));
  }
  if (!objects.empty()) return objects;
  auto parts = content::collision_parts(*scene, "");
  if (!parts) return tl::unexpected(parts.error());
  geometry::Mesh whole;
  for (const geometry::NamedMesh& part : *parts)
    whole.append(part.mesh);
  const double scale = kHeld_m / whole.bounds().diagonal().norm();
  for (Vec3& v : whole.vertices)
    v *= scale;
  objects.push_back(object_of(stem, {{stem, std::move(whole)}}, false, finest_m));
  return objects;
}

}  // namespace mechane::benchmark
