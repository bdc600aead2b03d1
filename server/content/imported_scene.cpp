#include "server/content/imported_scene.hpp"

#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/content/import_limits.hpp"
#include "server/geometry/mesh_check.hpp"

namespace mechane::content {
namespace {

constexpr std::string_view kPartPrefix = "part_";

/// Exporters write a corner once for each normal, each time with the same digits. Corners farther apart than this are different ones.
constexpr double kWeldTolerance_m = 1e-6;

/// Adds the triangles. Where the pose mirrors them, their corners change order, so that they still face outwards.
void append(const ImportedMesh& mesh, const Eigen::Affine3d& X_ON, geometry::Mesh& to) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  for (const Vec3f& p : mesh.positions)
    to.vertices.push_back(X_ON * p.cast<double>());
  const bool mirrored = X_ON.linear().determinant() < 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t b = mesh.indices[i + (mirrored ? 2 : 1)];
    const std::uint32_t c = mesh.indices[i + (mirrored ? 1 : 2)];
    to.triangles.push_back({first + mesh.indices[i], first + b, first + c});
  }
}

bool in_scope(const ImportedScene& scene, std::uint32_t node, std::optional<std::uint32_t> top) {
  return !top || is_under(scene, node, *top);
}

/// The nearest node, from `node` upwards to `top`, that is named as a part.
std::optional<std::uint32_t> owner(const ImportedScene& scene, std::uint32_t node, std::optional<std::uint32_t> top) {
  for (std::optional<std::uint32_t> at = node; at; at = scene.nodes[*at].parent) {
    if (scene.nodes[*at].name.starts_with(kPartPrefix)) return at;
    if (at == top) break;
  }
  return std::nullopt;
}

std::uint64_t placed_triangles(const ImportedScene& scene, const std::vector<std::uint32_t>& nodes) {
  std::uint64_t triangles = 0;
  for (const std::uint32_t node : nodes) {
    for (const std::uint32_t mesh : scene.nodes[node].meshes)
      triangles += scene.meshes[mesh].indices.size() / 3;
  }
  return triangles;
}

}  // namespace

std::optional<std::uint32_t> find_node(const ImportedScene& scene, const std::string& name) {
  for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].name == name) return i;
  }
  return std::nullopt;
}

bool is_under(const ImportedScene& scene, std::uint32_t node, std::uint32_t ancestor) {
  for (std::optional<std::uint32_t> at = node; at; at = scene.nodes[*at].parent) {
    if (*at == ancestor) return true;
  }
  return false;
}

Eigen::Affine3d pose_in(const ImportedScene& scene, std::uint32_t node, std::optional<std::uint32_t> ancestor) {
  Eigen::Affine3d X_AN = Eigen::Affine3d::Identity();
  std::optional<std::uint32_t> at = node;
  for (; at && at != ancestor; at = scene.nodes[*at].parent)
    X_AN = scene.nodes[*at].X_PN * X_AN;
  MECHANE_ASSERT(at == ancestor);
  return X_AN;
}

Expected<std::vector<geometry::NamedMesh>> collision_parts(const ImportedScene& scene, const std::string& node) {
  std::optional<std::uint32_t> top;
  if (!node.empty()) {
    top = find_node(scene, node);
    if (!top) {
      return fail(ErrorCode::unknown_name, "the file has no node of this name", "node " + node,
                  "give the object this name in the model, or correct the name");
    }
  }
  std::vector<std::uint32_t> shown;
  bool named = false;
  for (std::uint32_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].meshes.empty() || !in_scope(scene, i, top)) continue;
    shown.push_back(i);
    named = named || owner(scene, i, top).has_value();
  }
  if (named) std::erase_if(shown, [&](std::uint32_t i) { return !owner(scene, i, top); });
  if (const std::uint64_t triangles = placed_triangles(scene, shown); triangles > ImportLimits{}.triangles) {
    return fail(ErrorCode::too_large,
                fmt::format("{} triangles, counted wherever a mesh is placed; at most {} can be touched", triangles,
                            ImportLimits{}.triangles),
                node.empty() ? "" : "node " + node,
                "give the objects that visitors touch names that begin with part_, or simplify the model");
  }
  std::map<std::uint32_t, geometry::Mesh> gathered;  // by node, in the file's order
  for (const std::uint32_t i : shown) {
    const std::uint32_t part = named ? *owner(scene, i, top) : i;
    const Eigen::Affine3d X_ON = pose_in(scene, i, top);
    for (const std::uint32_t mesh : scene.nodes[i].meshes)
      append(scene.meshes[mesh], X_ON, gathered[part]);
  }
  std::vector<geometry::NamedMesh> parts;
  for (const auto& [part, mesh] : gathered) {
    geometry::Mesh welded = geometry::weld(mesh, kWeldTolerance_m);
    if (!welded.empty()) parts.push_back({scene.nodes[part].name, std::move(welded)});
  }
  if (parts.empty()) {
    return fail(ErrorCode::missing, "there is nothing to touch: no mesh has a surface",
                node.empty() ? "" : "node " + node, "give the node a mesh, or its parts names that begin with part_");
  }
  return parts;
}

}  // namespace mechane::content
