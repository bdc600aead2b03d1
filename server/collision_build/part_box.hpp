// The tight box of a part, which can take the place of its superquadric: as the frame of its map, and as its bound.
#pragma once

#include <span>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/geometry/fitting/fit.hpp"

namespace mechane::collision_build {

/// The smallest box around `bound_points_O` that turning about one axis after another finds, from the points' principal axes and from
/// the object's own. Its shape comes as the squarest superquadric around it (exponents 0.1), so F <= 1 at every point. The report's
/// errors are the box's, from and to `surface_points_O`, in % of the diagonal of the bound points. Error: the points lie on a plane.
[[nodiscard]] Expected<geometry::FitResult> fit_box(std::span<const Vec3> bound_points_O,
                                                    std::span<const Vec3> surface_points_O);

}  // namespace mechane::collision_build
