// A triangle mesh: the exact shape that everything else approximates.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "server/base/math.hpp"

namespace mechane::geometry {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

/// Triangles wind counter-clockwise seen from outside. Metres.
struct Mesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool empty() const { return triangles.empty(); }
  [[nodiscard]] Eigen::AlignedBox3d bounds() const {
    Eigen::AlignedBox3d box;
    for (const Vec3& v : vertices)
      box.extend(v);
    return box;
  }
  /// Adds another mesh beside what there is; nothing is welded.
  void append(const Mesh& other) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& t : other.triangles)
      triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  }
};

/// A mesh with the name of the file's node that it came from.
struct NamedMesh {
  std::string name;
  Mesh mesh;
};

}  // namespace mechane::geometry
