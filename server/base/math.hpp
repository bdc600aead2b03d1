// Vectors, poses, wrenches, in double precision. Monogram notation (see ARCHITECTURE.md): X_WB is the pose of frame B in frame W,
// p_WQ the position of point Q in W, f_B_W the force on B expressed in W. SI units.
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace mechane {

using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;
using Quat = Eigen::Quaterniond;

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kPiF = std::numbers::pi_v<float>;
inline constexpr float kTwoPiF = 2 * kPiF;

/// sgn(base) |base|^exponent: what papers on superquadrics write as base^exponent.
[[nodiscard]] inline double signed_power(double base, double exponent) {
  return std::copysign(std::pow(std::abs(base), exponent), base);
}

/// The least of 1, 2, 5, 10, 20 ... (and of .5, .2, .1 ...) that is not below `value`, which must be above 0. For the ends of scales.
[[nodiscard]] inline double round_up_to_scale(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  }
  return 10 * decade;
}

/// R v, for R of unit length. The same operations in the same order as Eigen's `R * v`, so the same bits, but always inlined: up to a
/// quarter of a tick went into calls of Eigen's.
[[nodiscard, gnu::always_inline]] inline Vec3 rotate(const Quat& R, const Vec3& v) {
  const double* q = R.coeffs().data();  // x, y, z, w
  const double x = v.x(), y = v.y(), z = v.z();
  double ux = q[1] * z - q[2] * y;
  double uy = q[2] * x - q[0] * z;
  double uz = q[0] * y - q[1] * x;
  ux += ux;
  uy += uy;
  uz += uz;
  return {x + q[3] * ux + (q[1] * uz - q[2] * uy), y + q[3] * uy + (q[2] * ux - q[0] * uz),
          z + q[3] * uz + (q[0] * uy - q[1] * ux)};
}

/// A rigid transform X_AB: rotates by R_AB, then shifts by p_AB. `R` must be of unit length.
struct Pose {
  Vec3 p = Vec3::Zero();
  Quat R = Quat::Identity();

  [[nodiscard, gnu::always_inline]] Vec3 operator*(const Vec3& p_BQ) const { return rotate(p_BQ) + p; }
  [[nodiscard]] Pose operator*(const Pose& X_BC) const { return {rotate(X_BC.p) + p, R * X_BC.R}; }
  [[nodiscard]] Pose inverse() const {
    const Quat R_BA = R.conjugate();
    return {-mechane::rotate(R_BA, p), R_BA};
  }
  [[nodiscard, gnu::always_inline]] Vec3 rotate(const Vec3& v_B) const { return mechane::rotate(R, v_B); }
};

/// Linear and angular velocity of a frame, of its own origin, expressed in W: m/s, rad/s.
struct Twist {
  Vec3 v = Vec3::Zero();
  Vec3 w = Vec3::Zero();

  /// Velocity of a point that is fixed in the moving frame, `r` away from the frame's origin (in W).
  [[nodiscard]] Vec3 at(const Vec3& r) const { return v + w.cross(r); }
};

/// Force and torque, expressed in W: N, N m.
struct Wrench {
  Vec3 f = Vec3::Zero();
  Vec3 t = Vec3::Zero();
};

/// The rotation vector (axis times angle, |angle| <= pi) of a unit quaternion, radians.
[[nodiscard]] inline Vec3 rotation_vector(const Quat& q) {
  const Quat s = q.w() < 0 ? Quat(-q.w(), -q.x(), -q.y(), -q.z()) : q;
  const double sine = s.vec().norm();
  if (sine < 1e-12) return 2.0 * s.vec();
  return (2.0 * std::atan2(sine, s.w()) / sine) * s.vec();
}

/// The mean velocity, in W, of what went from one pose to another in that time (> 0).
[[nodiscard]] inline Twist mean_twist(const Pose& from, const Pose& to, double time_s) {
  return {(to.p - from.p) / time_s, rotation_vector(to.R * from.R.conjugate()) / time_s};
}

/// The unit quaternion of a rotation vector, radians.
[[nodiscard]] inline Quat quat_from_rotation_vector(const Vec3& r) {
  const double angle = r.norm();
  if (angle < 1e-12) return Quat(1, r.x() / 2, r.y() / 2, r.z() / 2).normalized();
  return Quat(Eigen::AngleAxisd(angle, r / angle));
}

}  // namespace mechane
