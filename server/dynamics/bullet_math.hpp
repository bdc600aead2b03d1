// Our vectors and poses as Bullet's, and back.
#pragma once

#include "server/base/math.hpp"

class btQuaternion;
class btTransform;
class btVector3;

namespace mechane::dynamics {

[[nodiscard]] btVector3 to_bt(const Vec3& v) noexcept;
[[nodiscard]] btQuaternion to_bt(const Quat& q) noexcept;
[[nodiscard]] btTransform to_bt(const Pose& X) noexcept;
[[nodiscard]] Vec3 from_bt(const btVector3& v) noexcept;

}  // namespace mechane::dynamics
