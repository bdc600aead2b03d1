#include "server/dynamics/grasp_rows.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::dynamics {
namespace {

constexpr double kSlip_rad = 0.6;            // up to this, only the torque limit lets it lag, and it comes back
constexpr double kMaxDamping_ns_per_m = 60;  // a stronger damper is felt as a jolt when the grip begins
constexpr double kAcrossShare = 0.25;        // of a limit, across the spring's direction

struct SpringStep {
  double softness = 0;    // 1/kg or 1/(kg m^2)
  double bias_per_s = 0;  // bias velocity of a unit error
};

SpringStep implicit_step(double stiffness, double damping, double dt_s) {
  const double drag = stiffness * dt_s + damping;
  if (drag <= 0) return {};
  return {1 / (dt_s * drag), stiffness / drag};
}

/// Three axes, the first along `direction` (any, where that is zero).
Mat3 axes_along(const Vec3& direction) {
  const double size = direction.norm();
  const Vec3 first = size > 1e-12 ? Vec3(direction / size) : Vec3::UnitX();
  Mat3 axes;
  axes.col(0) = first;
  axes.col(1) = first.unitOrthogonal();
  axes.col(2) = first.cross(axes.col(1));
  return axes;
}

void limit(Row& row, int axis, double most) {
  const double share = axis == 0 ? 1.0 : kAcrossShare;
  row.max_impulse = most * share;
  row.min_impulse = -row.max_impulse;
}

/// Where the body lags too far behind the hand's rotation, it turns in the grip about the grip's centre: a crank's handle goes round
/// in a hand that does not.
Vec3 slip(const GripSpring& spring, const Pose& X_WB, state::UserState& user) {
  state::Grasp& grasp = user.grasp;
  const Vec3 error_W = rotation_vector(user.X_WH.R * grasp.X_HB.R * X_WB.R.conjugate());
  const double angle = error_W.norm();
  const double most = std::clamp(grasp.torque_limit_nm / spring.stiffness_nm_per_rad, kSlip_rad, kPi / 2);
  if (angle <= most) return error_W;
  const Vec3 left_W = error_W * (most / angle);
  const Vec3 p_HG = grasp.X_HB * grasp.p_BG;
  grasp.X_HB.R = (user.X_WH.R.conjugate() * quat_from_rotation_vector(left_W) * X_WB.R).normalized();
  grasp.X_HB.p = p_HG - grasp.X_HB.R * grasp.p_BG;
  return left_W;
}

}  // namespace

GripBody grip_body(const state::BodyDescription& body) noexcept {
  const double gyration_m2 = body.mass_kg > 0 ? body.inertia_kg_m2.trace() / (2 * body.mass_kg) : 0;
  return {std::max(0.0, body.haptic.stiffness_n_per_m), body.mass_kg * body.effort_scale, gyration_m2, body.p_BCm};
}

GripSpring grip_spring(const GripBody& body, const Vec3& p_BG) noexcept {
  const double k = body.stiffness_n_per_m;
  const double d = std::min(2 * std::sqrt(k * body.mass_kg), kMaxDamping_ns_per_m);
  const double lever2 = body.gyration_m2 + (p_BG - body.p_BCm).squaredNorm();
  return {k, d, k * lever2, d * lever2};
}

void grasp_rows(const GripSpring& spring, const Frame& body, state::UserState& user, double dt_s,
                RowSet& rows) noexcept {
  rows.clear();
  const SpringStep linear = implicit_step(spring.stiffness_n_per_m, spring.damping_ns_per_m, dt_s);
  const SpringStep angular = implicit_step(spring.stiffness_nm_per_rad, spring.damping_nms_per_rad, dt_s);
  if (linear.softness <= 0 || angular.softness <= 0) return;

  const Vec3 p_WG = body.X_WB * user.grasp.p_BG;
  const Vec3 turn_error_W = slip(spring, body.X_WB, user);
  const Vec3 p_WG_wanted = user.X_WH * (user.grasp.X_HB * user.grasp.p_BG);
  const Vec3 error_W = p_WG_wanted - p_WG;
  const Twist V_WG{user.V_WH.at(p_WG_wanted - user.X_WH.p), user.V_WH.w};

  const double share = std::clamp(user.freshness, 0.0, 1.0) * dt_s;
  const Frame hand{{p_WG, Quat::Identity()}, p_WG, V_WG, 0, Mat3::Zero()};
  const Vec3 v_body = body.V_WCm.at(p_WG - body.p_WCm);
  const Mat3 n = axes_along(spring.stiffness_n_per_m * error_W + spring.damping_ns_per_m * (V_WG.v - v_body));
  const Mat3 a =
      axes_along(spring.stiffness_nm_per_rad * turn_error_W + spring.damping_nms_per_rad * (V_WG.w - body.V_WCm.w));
  for (int k = 0; k < 3; ++k) {
    Row& row = rows.add(linear_row(hand, body, p_WG, n.col(k)));
    row.target = n.col(k).dot(linear.bias_per_s * error_W + V_WG.v);
    row.softness = linear.softness;
    limit(row, k, user.grasp.force_limit_n * share);
  }
  for (int k = 0; k < 3; ++k) {
    Row& row = rows.add(angular_row(a.col(k)));
    row.target = a.col(k).dot(angular.bias_per_s * turn_error_W + V_WG.w);
    row.softness = angular.softness;
    limit(row, k, user.grasp.torque_limit_nm * share);
  }
}

}  // namespace mechane::dynamics
