// Polygons as X3D's geometry nodes describe them, before they are triangles with normals.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Metres, in the shape's frame.
struct Faces {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  struct Corner {
    std::uint32_t point = 0;
    std::uint32_t uv = kNone;
    std::uint32_t normal = kNone;
  };

  std::vector<Vec3> points;
  std::vector<Eigen::Vector2f> uv;  ///< (0, 0) is the image's lower left corner, as in X3D
  std::vector<Vec3f> normals;
  std::vector<Corner> corners;      ///< of all faces, one after the other
  std::vector<std::uint32_t> ends;  ///< of each face: the end of its corners
  double crease_rad = 0;            ///< faces that meet at a smaller angle look smooth
  bool counter_clockwise = true;    ///< seen from outside
  bool seen_from_both_sides = false;

  /// Adds a face of corners in the order given.
  void add(std::span<const Corner> face);
};

/// Triangles with normals. Faces without area are left out. `material` stays 0. With `textured`, points without uv get X3D's default: the
/// image lies over the two longest sides of the box around them.
[[nodiscard]] ImportedMesh mesh_of(const Faces& faces, bool textured);

}  // namespace mechane::content
