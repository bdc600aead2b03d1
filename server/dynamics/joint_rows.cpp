#include "server/dynamics/joint_rows.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::dynamics {
namespace {

constexpr double kLimitHorizon_s = 0.05;  // a limit gets its row when the joint could reach it within this time

using state::JointKind;

void lock_rotation(const Quat& R_WJ1, const Vec3& error_W, bool about_z_too, double dt_s, RowSet& rows) {
  for (int k = 0; k < (about_z_too ? 3 : 2); ++k) {
    const Vec3 n_W = R_WJ1 * Vec3::Unit(k);
    rows.add(angular_row(n_W)).target = correction(n_W.dot(error_W), dt_s, kMaxAngularCorrection);
  }
}

void lock_position(const Frame& body1, const Frame& body2, const Pose& X_WJ1, const Vec3& p_WJ2, int first_axis,
                   int end_axis, double dt_s, RowSet& rows) {
  const Vec3 error_W = X_WJ1.p - p_WJ2;
  for (int k = first_axis; k < end_axis; ++k) {
    const Vec3 n_W = X_WJ1.rotate(Vec3::Unit(k));
    rows.add(linear_row(body1, body2, p_WJ2, n_W)).target = correction(n_W.dot(error_W), dt_s, kMaxLinearCorrection);
  }
}

/// A screw's thread: along the axis it goes `pitch` for each radian.
void lock_thread(const Frame& body1, const Frame& body2, const Pose& X_WJ1, const JointMeasure& now, double pitch,
                 double dt_s, RowSet& rows) {
  const double error = pitch * now.position - now.axis_W.dot(now.p_WJ - X_WJ1.p);
  Row row = linear_row(body1, body2, now.p_WJ, now.axis_W);
  row.a1_W -= pitch * now.axis_W;
  row.a2_W -= pitch * now.axis_W;
  row.target = correction(error, dt_s, kMaxLinearCorrection);
  rows.add(row);
}

void add_friction(const Row& axis_row, const state::JointState& state, double dt_s, RowSet& rows) {
  const double most = (state.friction + state.resistance) * dt_s;
  if (most <= 0) return;
  Row& row = rows.add(axis_row);
  row.target = 0;
  row.min_impulse = -most;
  row.max_impulse = most;
}

void add_limits(const Row& axis_row, const state::JointState& state, const JointMeasure& now, double max_speed,
                double dt_s, RowSet& rows) {
  if (state.min_position > state.max_position) return;
  const double reach = (std::abs(now.velocity) + max_speed) * kLimitHorizon_s;
  if (now.position - state.min_position < reach) {
    Row& row = rows.add(axis_row);
    row.target = limit_speed(state.min_position - now.position, dt_s, max_speed);
    row.min_impulse = 0;
  }
  if (state.max_position - now.position < reach) {
    Row& row = rows.add(axis_row);
    row.target = -limit_speed(now.position - state.max_position, dt_s, max_speed);
    row.max_impulse = 0;
  }
}

/// One row at the edge of a ball's cone. On the cone's axis there is no direction outwards, and no row is needed.
void add_cone(const state::JointState& state, const Pose& X_WJ1, const Pose& X_WJ2, double dt_s, RowSet& rows) {
  if (state.cone_axis_J.isZero()) return;
  const Vec3 at_W = X_WJ1.rotate(state.cone_axis_J), is_W = X_WJ2.rotate(state.cone_axis_J);
  const Vec3 about_W = at_W.cross(is_W);
  const double sine = about_W.norm();
  if (sine < 1e-9) return;
  const double angle = std::atan2(sine, at_W.dot(is_W));
  Row& row = rows.add(angular_row(about_W / sine));
  row.target = -limit_speed(angle - state.cone_rad, dt_s, kMaxAngularCorrection);
  row.max_impulse = 0;
}

/// The angle of the turn that is nearest to `near`.
double unwrap(double angle, double near) {
  return angle + 2 * kPi * std::round((near - angle) / (2 * kPi));
}

}  // namespace

JointMeasure measure_joint(const state::JointDescription& joint, const Frame& body1, const Frame& body2,
                           double near) noexcept {
  const Pose X_WJ1 = body1.X_WB * joint.X_B1J;
  const Pose X_WJ2 = body2.X_WB * joint.X_B2J;
  JointMeasure out;
  out.p_WJ = X_WJ2.p;
  if (joint.kind == JointKind::hinge) {
    const Quat R_J1J2 = X_WJ1.R.conjugate() * X_WJ2.R;
    out.axis_W = X_WJ1.rotate(Vec3::UnitZ());
    out.position = unwrap(2 * std::atan2(R_J1J2.z(), R_J1J2.w()), near);
    out.velocity = row_velocity(angular_row(out.axis_W), body1, body2);
  } else if (joint.kind == JointKind::slider) {
    out.axis_W = X_WJ1.rotate(Vec3::UnitX());
    out.position = out.axis_W.dot(X_WJ2.p - X_WJ1.p);
    out.velocity = row_velocity(linear_row(body1, body2, X_WJ2.p, out.axis_W), body1, body2);
  }
  return out;
}

Row joint_axis_row(const state::JointDescription& joint, const Frame& body1, const Frame& body2,
                   const JointMeasure& now) noexcept {
  switch (joint.kind) {
    case JointKind::hinge:
      return angular_row(now.axis_W);
    case JointKind::slider:
      return linear_row(body1, body2, now.p_WJ, now.axis_W);
    case JointKind::ball:
      break;
  }
  return {};
}

void joint_rows(const state::JointDescription& joint, const state::JointState& state, const Frame& body1,
                const Frame& body2, const JointMeasure& now, double dt_s, RowSet& rows) noexcept {
  rows.clear();
  const Pose X_WJ1 = body1.X_WB * joint.X_B1J;
  const Pose X_WJ2 = body2.X_WB * joint.X_B2J;
  switch (joint.kind) {
    case JointKind::ball:
      lock_position(body1, body2, X_WJ1, X_WJ2.p, 0, 3, dt_s, rows);
      add_cone(state, X_WJ1, X_WJ2, dt_s, rows);
      break;
    case JointKind::hinge: {
      const Vec3 error_W = X_WJ2.rotate(Vec3::UnitZ()).cross(now.axis_W);
      if (state.pitch_m_per_rad == 0) {
        lock_position(body1, body2, X_WJ1, X_WJ2.p, 0, 3, dt_s, rows);
      } else {
        lock_position(body1, body2, X_WJ1, X_WJ2.p, 0, 2, dt_s, rows);
        lock_thread(body1, body2, X_WJ1, now, state.pitch_m_per_rad, dt_s, rows);
      }
      lock_rotation(X_WJ1.R, error_W, false, dt_s, rows);
      const Row axis_row = joint_axis_row(joint, body1, body2, now);
      add_friction(axis_row, state, dt_s, rows);
      add_limits(axis_row, state, now, kMaxAngularCorrection, dt_s, rows);
      break;
    }
    case JointKind::slider: {
      const Vec3 error_W = rotation_vector(X_WJ1.R * X_WJ2.R.conjugate());
      lock_position(body1, body2, X_WJ1, X_WJ2.p, 1, 3, dt_s, rows);
      lock_rotation(X_WJ1.R, error_W, true, dt_s, rows);
      const Row axis_row = joint_axis_row(joint, body1, body2, now);
      add_friction(axis_row, state, dt_s, rows);
      add_limits(axis_row, state, now, kMaxLinearCorrection, dt_s, rows);
      break;
    }
  }
}

}  // namespace mechane::dynamics
