// What a held object's hinge or slider, or its weight, does to a hand, rendered by a client at its device's own rate.
#pragma once

#include "server/base/clock.hpp"
#include "server/base/math.hpp"
#include "server/hand/hand_force.hpp"

namespace mechane::hand {

/// The force on the hand at the place where it holds the body, N in W: a spring and damper across the path, up to the grip's limit, and
/// `along_share` (0 .. 1) of what the server found along it, which turns with the path. `age` is the time since the path was received, on
/// the caller's own clock; past its validity it fades out, see share_left(). Within half a circle's radius of its axis, what points to the
/// circle or along it fades out. Zero where no hinge or slider holds the body. Any thread; allocates nothing.
[[nodiscard]] Vec3 held_path_force(const HeldPath& path, const Pose& X_WH, const Twist& V_WH, Duration age,
                                   double along_share) noexcept;

/// The weight of what is carried freely, on the hand at H, N and N m in W; of anything else zero. It does not depend on where the hand is,
/// so that no delay makes it unstable. `age` as above. Any thread; allocates nothing.
[[nodiscard]] Wrench held_weight(const HeldPath& path, const Pose& X_WH, Duration age) noexcept;

}  // namespace mechane::hand
