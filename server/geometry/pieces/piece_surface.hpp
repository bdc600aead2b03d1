// The part of a mesh's surface that lies in a convex cell, for sampling: triangles, cut at the planes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/pieces/cut_plane.hpp"

namespace mechane::geometry {

struct OrientedPoint {
  Vec3 p = Vec3::Zero();
  Vec3 n = Vec3::Zero();  ///< outward unit normal of its triangle
};

/// Holds whole triangles by index, cut ones as they are: the mesh must outlive it.
class PieceSurface {
 public:
  explicit PieceSurface(const Mesh& mesh);

  /// The surface in the half-space, and the rest. A triangle that lies in the plane goes to the side that its solid is on.
  [[nodiscard]] std::pair<PieceSurface, PieceSurface> split(const HalfSpace& plane) const;

  /// Of two pieces whose surfaces have no part in common.
  [[nodiscard]] static PieceSurface joined(const PieceSurface& a, const PieceSurface& b);

  [[nodiscard]] double area_m2() const;
  [[nodiscard]] bool empty() const { return whole_.empty() && cut_.empty(); }

  /// `count` points of even density, or none where there is no area.
  [[nodiscard]] std::vector<OrientedPoint> sample(std::size_t count, std::uint64_t seed) const;

  /// About `count` corners of triangles, spread evenly over their list.
  [[nodiscard]] std::vector<OrientedPoint> corners(std::size_t count) const;

  /// The greatest n.p; minus infinity where it is empty.
  [[nodiscard]] double reach(const Vec3& n) const;

 private:
  using Triangle = std::array<Vec3, 3>;
  [[nodiscard]] Triangle triangle(std::size_t i) const;

  const Mesh* mesh_;
  std::vector<std::uint32_t> whole_;
  std::vector<Triangle> cut_;
};

}  // namespace mechane::geometry
