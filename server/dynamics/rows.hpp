// Constraint rows between two bodies, independent of any engine: joints and grasps write them, and the solver fulfils them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "server/base/math.hpp"

namespace mechane::dynamics {

/// A body at the start of a step, as rows need it.
struct Frame {
  Pose X_WB;
  Vec3 p_WCm = Vec3::Zero();              ///< centre of mass
  Twist V_WCm;                            ///< velocity of the centre of mass
  double inverse_mass = 0;                ///< 1/kg; 0: it does not move
  Mat3 inverse_inertia_W = Mat3::Zero();  ///< about the centre of mass, 1/(kg m^2)
};

/// One row: `target` is the wanted value of n.(v2 - v1) + a2.w2 - a1.w1, where v and w are velocities of the centres of mass after
/// the step. The solver finds the impulse (N s, N m s) along the row, within its limits, that brings it there; where the row is soft,
/// all but `softness` times the impulse.
struct Row {
  Vec3 n_W = Vec3::Zero();
  Vec3 a1_W = Vec3::Zero();
  Vec3 a2_W = Vec3::Zero();
  double target = 0;
  double min_impulse = -std::numeric_limits<double>::infinity();
  double max_impulse = std::numeric_limits<double>::infinity();
  double softness = 0;  ///< 1/kg, 1/(kg m^2)
};

/// The rows of one joint or grasp.
struct RowSet {
  static constexpr std::size_t kMost = 9;
  std::array<Row, kMost> rows{};
  std::size_t count = 0;

  Row& add(const Row& row) noexcept { return rows[count++] = row; }
  void clear() noexcept { count = 0; }
};

/// A row on the relative velocity, along n, of the two body points that are at p_WQ now.
[[nodiscard]] inline Row linear_row(const Frame& body1, const Frame& body2, const Vec3& p_WQ,
                                    const Vec3& n_W) noexcept {
  Row row;
  row.n_W = n_W;
  row.a1_W = (p_WQ - body1.p_WCm).cross(n_W);
  row.a2_W = (p_WQ - body2.p_WCm).cross(n_W);
  return row;
}

/// A row on the relative angular velocity about n.
[[nodiscard]] inline Row angular_row(const Vec3& n_W) noexcept {
  Row row;
  row.a1_W = n_W;
  row.a2_W = n_W;
  return row;
}

/// The row's value at the velocities that the bodies have now.
[[nodiscard]] inline double row_velocity(const Row& row, const Frame& body1, const Frame& body2) noexcept {
  return row.n_W.dot(body2.V_WCm.v - body1.V_WCm.v) + row.a2_W.dot(body2.V_WCm.w) - row.a1_W.dot(body1.V_WCm.w);
}

inline constexpr double kErrorShare = 0.2;            ///< of a position error, taken back in a step
inline constexpr double kMaxLinearCorrection = 1.0;   ///< m/s
inline constexpr double kMaxAngularCorrection = 5.0;  ///< rad/s

/// Velocity that takes back `error` (m or rad).
[[nodiscard]] inline double correction(double error, double dt_s, double max_speed) noexcept {
  return std::clamp(kErrorShare * error / dt_s, -max_speed, max_speed);
}

/// Outside a limit the error is taken back softly; inside, the joint may go as far as the limit.
[[nodiscard]] inline double limit_speed(double error, double dt_s, double max_speed) noexcept {
  return error > 0 ? correction(error, dt_s, max_speed) : error / dt_s;
}

}  // namespace mechane::dynamics
