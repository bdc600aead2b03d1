// A small software rasteriser with orthographic projection: triangles into a depth buffer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::fit {

/// A camera without perspective. Screen frame: x to the right and y down in pixels, z towards the viewer in pixels too.
struct View {
  Mat3 R_VO = Mat3::Identity();  ///< rows: right, up, towards the viewer
  Vec3 center_O = Vec3::Zero();  ///< seen in the middle of the picture
  double px_per_m = 1;
  int width = 0;
  int height = 0;

  [[nodiscard]] Vec3 to_screen(const Vec3& p_O) const;
  [[nodiscard]] Vec3 to_object(const Vec3& p_screen) const;

  /// The same picture with `factor` times as many pixels along each side.
  [[nodiscard]] View finer(int factor) const;
};

/// A view from `azimuth` about the y axis (0: the viewer is on +z) and `elevation` above the horizon, radians, at one
/// pixel per metre; the caller scales it. `size_m` returns the mesh's size on the screen.
[[nodiscard]] View view_from(const geometry::Mesh& mesh, double azimuth, double elevation, Vec3& size_m);

/// The nearest triangle at each pixel.
struct DepthBuffer {
  static constexpr std::uint32_t kNothing = 0xFFFFFFFF;
  static constexpr float kFar = -1e30F;

  int width = 0;
  int height = 0;
  std::vector<float> z;                 ///< screen z; kFar where nothing is
  std::vector<std::uint32_t> triangle;  ///< kNothing where nothing is

  [[nodiscard]] bool covered(std::size_t pixel) const { return triangle[pixel] != kNothing; }
};

/// Draws both sides of triangles, so that open and inverted meshes are visible as well.
[[nodiscard]] DepthBuffer rasterise(const geometry::Mesh& mesh, const View& view);

/// Unit normals of a mesh for shading, one a triangle's corner: the mean over the neighbours around that corner, unless
/// a crease sharper than `crease_rad` parts them.
[[nodiscard]] std::vector<std::array<Vec3f, 3>> corner_normals(const geometry::Mesh& mesh, double crease_rad);

}  // namespace mechane::fit
