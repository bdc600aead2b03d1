// Hinge (and screw), slider and ball as constraint rows.
#pragma once

#include "server/dynamics/rows.hpp"
#include "server/state/world_state.hpp"

namespace mechane::dynamics {

/// Where a joint is: its axis, and its position along or about it.
struct JointMeasure {
  Vec3 axis_W = Vec3::Zero();  ///< of body1's side: z of a hinge, x of a slider; zero for a ball
  Vec3 p_WJ = Vec3::Zero();    ///< the joint on body2
  double position = 0;         ///< rad, continued from `near` over whole turns; m
  double velocity = 0;         ///< rad/s, m/s
};

/// Measures a joint at the bodies' poses and velocities. `near` is the last known position: a hinge's angle is the one of its turns
/// that is nearest to it.
[[nodiscard]] JointMeasure measure_joint(const state::JointDescription& joint, const Frame& body1, const Frame& body2,
                                         double near) noexcept;

/// Overwrites `rows` with what the joint asks for in a step of dt_s: its lock, its friction and resistance, its limits. Position errors
/// are taken back at a fifth per step, 1 m/s and 5 rad/s at most. Limits stop exactly: the row lets the joint reach its limit in this
/// step and no further. A hinge with a pitch is a screw: instead of staying where it is along its axis it moves as it turns. A ball with
/// a cone has one row, at the cone's edge. `now` is the joint measured at these frames.
void joint_rows(const state::JointDescription& joint, const state::JointState& state, const Frame& body1,
                const Frame& body2, const JointMeasure& now, double dt_s, RowSet& rows) noexcept;

/// The row of a joint's velocity; without terms for a ball.
[[nodiscard]] Row joint_axis_row(const state::JointDescription& joint, const Frame& body1, const Frame& body2,
                                 const JointMeasure& now) noexcept;

}  // namespace mechane::dynamics
