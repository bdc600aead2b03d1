// Where smooth faces meet in an edge or a corner, the distance to each is smooth; the distance to all is the largest or the least of
// these.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "server/base/math.hpp"

namespace mechane::collision {

/// A place in a block (B, with the block's edges as units), its distance to the surface and the normal there.
struct SheetSample {
  Vec3 p_B = Vec3::Zero();  ///< 0 to 1 along each edge of the block
  double distance_m = 0;    ///< negative inside
  Vec3 n_B = Vec3::Zero();  ///< unit, of the nearest face
  bool on_face = true;      ///< the nearest point lies in the face, and not on its edge
  double tolerance_m = 0;   ///< by how much the depth may err there; infinite where no finger gets
  double excess_m = 0;      ///< outside: by how much the distance may be too large, which culling has to allow for
};

/// Distances to two or three faces, each trilinear over the block, by their values at its corners: x fastest. Together they are
/// first o (second i third), where o and i take the larger of two (an edge that sticks out) or the lesser (an inner corner).
struct Sheets {
  int count = 2;
  std::array<std::array<double, 8>, 3> values_m{};
  bool outer_convex = true;  ///< o takes the larger
  bool inner_convex = true;  ///< i does
};

/// The distance that the sheets give.
[[nodiscard]] double distance_of(const Sheets& sheets, const Vec3& p_B);

/// Fits sheets in turns: samples go to the sheet that gives their distance best, then sheets are fitted to their samples (as for
/// max-affine functions, Magnani and Boyd 2009). Where there is only one face, the sheets are the same. Empty if no sheets give each
/// depth well enough.
[[nodiscard]] std::optional<Sheets> fit_sheets(std::span<const SheetSample> samples, double block_m);

}  // namespace mechane::collision
