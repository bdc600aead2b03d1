// Cuts of a piece into many at once: slices by parallel planes, sectors by planes through an axis. A search that cuts in two each time
// does not find them: three equal turns of a thread, seven staves of a barrel.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "server/geometry/pieces/piece_region.hpp"

namespace mechane::geometry {

/// For each piece, the half-spaces that confine it within the region.
using FanPlan = std::vector<std::vector<HalfSpace>>;

/// The plan with the fewest pieces, at most `most`, such that no chord within one is deeper than `bound_m`, as far as the region's
/// points show; of several with the same number, the one of least depth. Empty if there is no such plan.
[[nodiscard]] std::optional<FanPlan> find_fan(const PieceRegion& region, double bound_m, std::size_t most);

/// Directions along which an object was probably built: the principal axes of the points, then x, y, z where they differ.
[[nodiscard]] std::vector<Vec3> likely_axes(const std::vector<Vec3>& points);

/// The mean of the points.
[[nodiscard]] Vec3 middle_of(const std::vector<Vec3>& points);

}  // namespace mechane::geometry
