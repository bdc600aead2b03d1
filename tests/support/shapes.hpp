// Meshes of known shape: a box, a cylinder, a barrel of staves, a crank.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "server/geometry/mesh.hpp"

namespace mechane::test {

/// The six-sided solid over a grid of eight corners: bottom ring a b c d (counter-clockwise seen from above), top ring above it.
inline geometry::Mesh hexahedron(const std::array<Vec3, 8>& corners) {
  geometry::Mesh mesh;
  mesh.vertices.assign(corners.begin(), corners.end());
  const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  quad(3, 2, 1, 0);
  quad(4, 5, 6, 7);
  for (std::uint32_t i = 0; i < 4; ++i)
    quad(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i);
  return mesh;
}

inline geometry::Mesh box(const Vec3& half, const Vec3& center = Vec3::Zero()) {
  std::array<Vec3, 8> corners;
  const int ring[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int i = 0; i < 8; ++i) {
    corners[i] = center + Vec3(ring[i % 4][0], ring[i % 4][1], i < 4 ? -1 : 1).cwiseProduct(half);
  }
  return hexahedron(corners);
}

/// Along z, closed by fans.
inline geometry::Mesh cylinder(double radius, double half_length, std::uint32_t sides,
                               const Vec3& center = Vec3::Zero()) {
  geometry::Mesh mesh;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    const Vec3 rim(radius * std::cos(angle), radius * std::sin(angle), 0);
    mesh.vertices.push_back(center + rim - half_length * Vec3::UnitZ());
    mesh.vertices.push_back(center + rim + half_length * Vec3::UnitZ());
  }
  mesh.vertices.push_back(center - half_length * Vec3::UnitZ());
  mesh.vertices.push_back(center + half_length * Vec3::UnitZ());
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 2 * i;
    const std::uint32_t b = 2 * ((i + 1) % sides);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    mesh.triangles.push_back({2 * sides, b, a});
    mesh.triangles.push_back({2 * sides + 1, a + 1, b + 1});
  }
  return mesh;
}

/// A hollow barrel along z, of flat or curved staves that share their side faces; `gap_m` leaves a crack between them.
inline std::vector<geometry::NamedMesh> barrel(int staves, double inner_radius, double outer_radius, double half_length,
                                               int facets_per_stave = 1, double gap_m = 0) {
  std::vector<geometry::NamedMesh> parts;
  for (int s = 0; s < staves; ++s) {
    geometry::NamedMesh part;
    part.name = "stave " + std::to_string(s);
    const double from = 2 * kPi * s / staves + 0.5 * gap_m / inner_radius;
    const double to = 2 * kPi * (s + 1) / staves - 0.5 * gap_m / inner_radius;
    auto& v = part.mesh.vertices;
    auto& t = part.mesh.triangles;
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      t.push_back({a, b, c});
      t.push_back({a, c, d});
    };
    // Four vertices at each angle: inner and outer, bottom and top.
    for (int f = 0; f <= facets_per_stave; ++f) {
      const double angle = from + (to - from) * f / facets_per_stave;
      const Vec3 out(std::cos(angle), std::sin(angle), 0);
      for (const double z : {-half_length, half_length}) {
        v.push_back(inner_radius * out + z * Vec3::UnitZ());
        v.push_back(outer_radius * out + z * Vec3::UnitZ());
      }
    }
    for (int f = 0; f < facets_per_stave; ++f) {
      const auto i = static_cast<std::uint32_t>(4 * f);
      const std::uint32_t n = i + 4;
      quad(i + 1, n + 1, n + 3, i + 3);  // outer wall
      quad(i, i + 2, n + 2, n);          // inner wall
      quad(i, n, n + 1, i + 1);          // bottom
      quad(i + 2, i + 3, n + 3, n + 2);  // top
    }
    const auto last = static_cast<std::uint32_t>(4 * facets_per_stave);
    quad(0, 1, 3, 2);
    quad(last, last + 2, last + 3, last + 1);
    parts.push_back(std::move(part));
  }
  return parts;
}

/// A crank: a shaft along z, an arm along x, a grip along z at the arm's end.
inline std::vector<geometry::NamedMesh> crank() {
  return {{"shaft", cylinder(0.02, 0.1, 24)},
          {"arm", box({0.12, 0.015, 0.01}, {0.11, 0, 0.1})},
          {"grip", cylinder(0.017, 0.06, 24, {0.21, 0, 0.165})}};
}

}  // namespace mechane::test
