// Meshes as scans and old models have them: with holes, noise, turned faces, pieces that overlap; and the exact winding number.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "server/base/random.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::test {

inline Vec3 middle_of(const geometry::Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
}

/// Without the triangles whose middle fulfils `in_hole`.
template <class InHole>
geometry::Mesh without(geometry::Mesh mesh, const InHole& in_hole) {
  std::vector<std::array<std::uint32_t, 3>> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!in_hole(middle_of(mesh, i))) kept.push_back(mesh.triangles[i]);
  }
  mesh.triangles = std::move(kept);
  return mesh;
}

/// A ball with `holes` round holes, each seen from its middle under the angle of `radius_rad` about its own.
inline geometry::Mesh ball_with_holes(double radius_m, int holes, double radius_rad, std::uint64_t seed,
                                      std::uint32_t around = 48) {
  Random random(seed);
  std::vector<Vec3> middles;
  for (int i = 0; i < holes; ++i)
    middles.push_back(Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5).normalized());
  return without(ball(radius_m, around), [&](const Vec3& p) {
    return std::any_of(middles.begin(), middles.end(),
                       [&](const Vec3& m) { return p.normalized().dot(m) > std::cos(radius_rad); });
  });
}

/// The lower half of a ball, a single sheet.
inline geometry::Mesh bowl(double radius_m, std::uint32_t around = 48) {
  return without(ball(radius_m, around), [](const Vec3& p) { return p.z() > 0; });
}

/// A share of the triangles turned.
inline geometry::Mesh with_turned(geometry::Mesh mesh, double share, std::uint64_t seed) {
  Random random(seed);
  for (auto& t : mesh.triangles) {
    if (random.unit() < share) std::swap(t[1], t[2]);
  }
  return mesh;
}

inline geometry::Mesh with_noise(geometry::Mesh mesh, double most_m, std::uint64_t seed) {
  Random random(seed);
  for (Vec3& v : mesh.vertices)
    v += most_m * Vec3(2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1);
  return mesh;
}

/// A share of the triangles lost.
inline geometry::Mesh with_gaps(geometry::Mesh mesh, double share, std::uint64_t seed) {
  Random random(seed);
  return without(std::move(mesh), [&](const Vec3&) { return random.unit() < share; });
}

/// Every triangle with its own back.
inline geometry::Mesh two_sided(geometry::Mesh mesh) {
  const std::size_t count = mesh.triangles.size();
  for (std::size_t i = 0; i < count; ++i)
    mesh.triangles.push_back({mesh.triangles[i][0], mesh.triangles[i][2], mesh.triangles[i][1]});
  return mesh;
}

/// By the solid angles of all triangles (tan of the half angle of a tetrahedron's corner, Euler): no tree, nothing approximated.
inline double exact_winding(const geometry::Mesh& mesh, const Vec3& p) {
  double halves = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = (mesh.vertices[t[0]] - p).normalized();
    const Vec3 b = (mesh.vertices[t[1]] - p).normalized();
    const Vec3 c = (mesh.vertices[t[2]] - p).normalized();
    halves += std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
  }
  return halves / (2 * kPi);
}

}  // namespace mechane::test
