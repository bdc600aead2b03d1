#include "server/dynamics/bullet_math.hpp"

#include <LinearMath/btTransform.h>

namespace mechane::dynamics {

btVector3 to_bt(const Vec3& v) noexcept {
  return {v.x(), v.y(), v.z()};
}
btQuaternion to_bt(const Quat& q) noexcept {
  return {q.x(), q.y(), q.z(), q.w()};
}
btTransform to_bt(const Pose& X) noexcept {
  return btTransform(to_bt(X.R), to_bt(X.p));
}
Vec3 from_bt(const btVector3& v) noexcept {
  return {v.x(), v.y(), v.z()};
}

}  // namespace mechane::dynamics
