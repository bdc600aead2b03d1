// Half-spaces, and the convex cells that they bound: with these the pieces of a decomposed solid are cut out.
#pragma once

#include <span>
#include <vector>

#include "server/base/math.hpp"

namespace mechane::geometry {

/// The points p with n.p <= d; n is of unit length, d in metres.
struct HalfSpace {
  Vec3 n;
  double d = 0;

  /// How far p lies beyond the plane; negative on the half-space's own side.
  [[nodiscard]] double excess(const Vec3& p) const { return n.dot(p) - d; }
  [[nodiscard]] HalfSpace flipped() const { return {-n, -d}; }
  [[nodiscard]] static HalfSpace through(const Vec3& p, const Vec3& unit_normal) {
    return {unit_normal, unit_normal.dot(p)};
  }
};

/// Whether p lies in all half-spaces, or at most `slack_m` beyond some.
[[nodiscard]] bool cell_contains(std::span<const HalfSpace> cell, const Vec3& p, double slack_m = 0);

/// Cuts off the part of a convex polygon outside the half-space. `scratch` saves allocations.
void clip_polygon(std::vector<Vec3>& polygon, const HalfSpace& half_space, std::vector<Vec3>& scratch);

/// The area of a flat polygon, whichever way it runs.
[[nodiscard]] double polygon_area_m2(const std::vector<Vec3>& polygon);

/// The polygon in which the plane of `plane` meets the box and the cell; `plane` itself may be one of the cell's. Empty where they
/// do not meet.
[[nodiscard]] std::vector<Vec3> plane_section(const HalfSpace& plane, std::span<const HalfSpace> cell,
                                              const Eigen::AlignedBox3d& box);

/// Points of a square lattice on a convex polygon with unit normal `n`. Wider than `spacing_m` where there would be more than `most`.
[[nodiscard]] std::vector<Vec3> lattice_on(const std::vector<Vec3>& polygon, const Vec3& n, double spacing_m,
                                           std::size_t most);

/// The half-spaces that bound the cell within the box: the others change nothing.
[[nodiscard]] std::vector<HalfSpace> without_redundant(std::span<const HalfSpace> cell, const Eigen::AlignedBox3d& box);

}  // namespace mechane::geometry
