// A triangle's normal and area at once.
#pragma once

#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

/// The outward normal of a triangle, as long as twice its area; zero where it has none. Any thread.
[[nodiscard]] inline Vec3 area_normal(const Mesh& mesh, std::size_t triangle) {
  const auto& v = mesh.triangles[triangle];
  const Vec3& a = mesh.vertices[v[0]];
  return (mesh.vertices[v[1]] - a).cross(mesh.vertices[v[2]] - a);
}

}  // namespace mechane::geometry
