#include "server/geometry/mesh_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace mechane::geometry {
namespace {

constexpr double kSmallest_m = 1e-6;
// A machine is a few metres large: over a kilometre the unit is wrong. Squares of it do not lose precision yet.
constexpr double kLargest_m = 1000;

}  // namespace

Expected<void> check_mesh(const Mesh& mesh, const std::string& where) {
  if (mesh.triangles.empty())
    return fail(ErrorCode::missing, "the mesh has no triangles", where, "export the model with its faces");
  if (mesh.triangles.size() > kMaxTriangles || mesh.vertices.size() > 3 * kMaxTriangles) {
    return fail(ErrorCode::too_large,
                "the mesh has " + std::to_string(mesh.triangles.size()) + " triangles and " +
                    std::to_string(mesh.vertices.size()) + " vertices",
                where, "simplify the collision shape to at most " + std::to_string(kMaxTriangles) + " triangles");
  }
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!mesh.vertices[i].allFinite() || mesh.vertices[i].cwiseAbs().maxCoeff() > kLargest_m) {
      return fail(ErrorCode::invalid_value, "vertex " + std::to_string(i) + " is not finite, or beyond 1000 m", where,
                  "check the model's units and modifiers, and export it again");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const std::uint32_t v : mesh.triangles[i]) {
      if (v < mesh.vertices.size()) continue;
      return fail(ErrorCode::damaged,
                  "triangle " + std::to_string(i) + " refers to vertex " + std::to_string(v) + " of " +
                      std::to_string(mesh.vertices.size()),
                  where, "the file is damaged: export it again");
    }
  }
  // Squares and cubes of lengths below a micrometre are lost in rounding.
  if (!(mesh.bounds().diagonal().norm() >= kSmallest_m)) {
    return fail(ErrorCode::invalid_value, "the mesh is smaller than a micrometre", where, "export the model in metres");
  }
  return {};
}

Mesh weld(const Mesh& mesh, double tolerance_m) {
  using Key = std::array<std::int64_t, 3>;
  const double scale = 1 / std::max(tolerance_m, 1e-12);
  std::map<Key, std::uint32_t> seen;
  Mesh out;
  std::vector<std::uint32_t> new_index(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3 scaled = mesh.vertices[i] * scale;
    const Key center{std::llround(scaled.x()), std::llround(scaled.y()), std::llround(scaled.z())};
    // A point beside a cell's border looks into the neighbouring cells too.
    auto found = seen.end();
    for (int n = 0; n < 27 && found == seen.end(); ++n) {
      const auto candidate = seen.find({center[0] + n % 3 - 1, center[1] + n / 3 % 3 - 1, center[2] + n / 9 - 1});
      if (candidate == seen.end()) continue;
      if ((out.vertices[candidate->second] - mesh.vertices[i]).norm() <= tolerance_m) found = candidate;
    }
    if (found == seen.end()) {
      found = seen.emplace(center, static_cast<std::uint32_t>(out.vertices.size())).first;
      out.vertices.push_back(mesh.vertices[i]);
    }
    new_index[i] = found->second;
  }
  std::set<std::array<std::uint32_t, 3>> known;
  for (const auto& t : mesh.triangles) {
    const std::array<std::uint32_t, 3> w{new_index[t[0]], new_index[t[1]], new_index[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    auto smallest_first = w;
    std::rotate(smallest_first.begin(), std::min_element(smallest_first.begin(), smallest_first.end()),
                smallest_first.end());
    if (known.insert(smallest_first).second) out.triangles.push_back(w);
  }
  return out;
}

Mesh weld(const Mesh& mesh) {
  return weld(mesh, 1e-6 * mesh.bounds().diagonal().norm());
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> rims(const Mesh& welded) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& t : welded.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i];
      const std::uint32_t to = t[(i + 1) % 3];
      if (from < to) ++balance[{from, to}];
      if (to < from) --balance[{to, from}];
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) open.push_back(edge);
  }
  return open;
}

std::size_t open_edges(const Mesh& welded) {
  return rims(welded).size();
}

double enclosed_volume_m3(const Mesh& mesh) {
  const Vec3 middle = mesh.bounds().center();
  double six_times = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]] - middle;
    six_times += a.dot((mesh.vertices[t[1]] - middle).cross(mesh.vertices[t[2]] - middle));
  }
  return six_times / 6;
}

}  // namespace mechane::geometry
