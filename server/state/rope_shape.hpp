// A rope as it is seen: a line of points along its middle. For displays; nothing in a tick uses it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/state/coupling.hpp"

namespace mechane::state {

/// Points along the middle of a rope, in W and metres, from what is wound on its drum to its end. `X_WN` are the poses of the nodes'
/// bodies and `R_W1` the attitude of the drum's bearer, as for measure_rope(). The same rope always has the same number of points, so
/// that a display can interpolate each: the drum's turns and each sheave's arc are spread over a fixed number. Slack hangs in the
/// longest free part, as a parabola. When the rope is off (cut, let go) its end hangs down from the last thing that it runs over. Any
/// thread; allocates.
[[nodiscard]] std::vector<Vec3> rope_shape(const Coupling& rope, const std::array<Pose, kMaxRopeNodes>& X_WN,
                                           const Quat& R_W1, const Vec3& down_W);

/// The same with the poses of all bodies of the world, by BodyId.
[[nodiscard]] std::vector<Vec3> rope_shape(const Coupling& rope, std::span<const Pose> X_WB, const Vec3& down_W);

}  // namespace mechane::state
