// A hand that holds a body, as constraint rows between the body and the hand.
#pragma once

#include "server/dynamics/rows.hpp"
#include "server/state/world_state.hpp"

namespace mechane::dynamics {

/// The spring and damper of a grip.
struct GripSpring {
  double stiffness_n_per_m = 0;
  double damping_ns_per_m = 0;
  double stiffness_nm_per_rad = 0;
  double damping_nms_per_rad = 0;
};

/// What every grip of a body depends on: simulated mass, haptic stiffness, how its mass is spread.
struct GripBody {
  double stiffness_n_per_m = 0;
  double mass_kg = 0;
  double gyration_m2 =
      0;  ///< half the trace of its inertia over its mass: for a long body, its transverse radius of gyration squared
  Vec3 p_BCm = Vec3::Zero();
};

[[nodiscard]] GripBody grip_body(const state::BodyDescription& body) noexcept;

/// The grip of a body at p_BG: as stiff as its haptic material, critically damped. In rotation it follows as fast as in translation:
/// the lever squared of the rotational spring is the body's inertia about the grip over its mass.
[[nodiscard]] GripSpring grip_spring(const GripBody& body, const Vec3& p_BG) noexcept;

/// Overwrites `rows` with the six rows of the grip of `user` on `body`; none where the body has no stiffness. body1 is the hand, which
/// moves as it moves: the targets hold its velocity. A row is an implicit spring and damper (constraint force mixing: with spring k,
/// damper d and step h, softness 1 / (h (k h + d)) and bias velocity k / (k h + d) times the error). The impulse limits hold the force's
/// and the torque's norm to their limits times the user's freshness, at most 6 % above where they act across the spring's own direction.
/// Turns grasp.X_HB where the body lags more than 35 degrees behind the hand's rotation: it slips in the hand.
void grasp_rows(const GripSpring& spring, const Frame& body, state::UserState& user, double dt_s,
                RowSet& rows) noexcept;

}  // namespace mechane::dynamics
