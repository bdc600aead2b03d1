#include "server/geometry/solid/sheet.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "server/geometry/area_normal.hpp"
#include "server/geometry/solid/shells.hpp"

namespace mechane::geometry {
namespace {

constexpr double kLeastCosine = 0.5;  // between a face and the mean normal of a corner; beyond it a spike would grow

/// By which each vertex moves for an offset of 1: along the mean normal, so far that the faces move by 1.
std::vector<Vec3> offsets_of(const Mesh& patch) {
  std::vector<Vec3> normals(patch.vertices.size(), Vec3::Zero());
  std::vector<double> area(patch.vertices.size());
  for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
    const Vec3 n = area_normal(patch, i);
    for (const std::uint32_t v : patch.triangles[i]) {
      normals[v] += n;
      area[v] += n.norm();
    }
  }
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (!(normals[v].norm() > 0)) continue;
    const double cosine = normals[v].norm() / area[v];  // the mean over the faces, by area
    normals[v] = normals[v].normalized() / std::max(cosine, kLeastCosine);
  }
  return normals;
}

Mesh plate_of(const Mesh& patch, double thickness_m) {
  const std::vector<Vec3> offsets = offsets_of(patch);
  const auto below = static_cast<std::uint32_t>(patch.vertices.size());
  Mesh plate;
  for (const double side : {0.5, -0.5}) {
    for (std::size_t v = 0; v < patch.vertices.size(); ++v)
      plate.vertices.push_back(patch.vertices[v] + side * thickness_m * offsets[v]);
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> ways;
  for (const auto& [a, b, c] : patch.triangles) {
    plate.triangles.push_back({a, b, c});
    plate.triangles.push_back({below + a, below + c, below + b});
    ways.insert({{a, b}, {b, c}, {c, a}});
  }
  for (const auto& [from, to] : ways) {
    if (ways.contains({to, from})) continue;
    plate.triangles.push_back({to, from, below + from});
    plate.triangles.push_back({to, below + from, below + to});
  }
  return plate;
}

}  // namespace

Mesh thickened(const Mesh& welded, double thickness_m) {
  Mesh all;
  for (const Shell& patch : patches_of(welded))
    all.append(plate_of(mesh_of(welded, patch), thickness_m));
  return all;
}

}  // namespace mechane::geometry
