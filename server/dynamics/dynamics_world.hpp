// Rigid bodies, their joints and the springs by which hands hold them, solved as a mechanism; contacts of free bodies by Bullet (float64).
#pragma once

#include <memory>

#include "server/base/error.hpp"
#include "server/state/world_state.hpp"

namespace mechane::dynamics {

/// The bodies, joints and grasps of one world. All state is in WorldState: a step reads poses, velocities and joint positions from
/// there, solves, and writes them back. When other rooms change something between two steps (a body put elsewhere, a joint switched, a
/// body held still) no further call is needed. So a world that is made anew from a snapshot goes on with the same bits.
///
/// Bodies move with mass and inertia times their `effort_scale`; gravity and their own damping act on them, as do
/// BodyState::load_W (at the body's origin), JointState::load and JointState::resistance; all of them are cleared by the step.
/// A fixed body, and one with `movable` false, has infinite mass and no velocity.
///
/// A joint that is switched on pulls its bodies together at 1 m/s and 5 rad/s at most; limits are hard; friction and resistance
/// hold up to their size and never drive. A hinge's position counts turns: it goes on from the position in the state. The position
/// of a joint that is off stays as it was, its velocity is 0.
///
/// A grasp pulls the body towards X_WH * X_HB with the stiffness of the body's haptic material, critically damped, up to
/// force_limit_n and torque_limit_nm times the user's freshness; in rotation as fast as in translation (see grasp_rows.hpp). Where
/// the body lags more than 35 degrees behind the hand's rotation, as a crank's handle does in a hand that goes round, it turns in
/// the grip: the step then turns Grasp::X_HB about the grip's centre. Grasp::reaction_W is what the body does to the hand, at the
/// grip.
///
/// Bodies collide where both opted in (BodyDescription::collides) and at least one can move, but for pairs that a joint ties (on or
/// off), mates, and bodies that are both in hands; hidden ones touch nothing. Their objects' maps are asked for contacts at the start
/// of each step, and the best four of a pair hold it apart: with the static friction of the bodies' haptic materials (the geometric
/// mean) up to 1 mm/s, the dynamic above. Bodies at rest on each other overlap by 0.1 mm; a larger overlap is taken back at 1 m/s at
/// most, without a kick. Only the places at a step are tested, not the way between: a plate stops a body that moves less than half
/// the plate's thickness in a step.
///
/// One thread at a time. step() allocates nothing, locks nothing, throws nothing; same inputs give the same bits.
class DynamicsWorld {
 public:
  /// Errors: a body that is not fixed has a mass or an inertia that is not positive, a joint has no second body or a frame that is
  /// not finite; see BodyContacts::create for bodies that collide. `state` must be made from `description`; neither is kept.
  [[nodiscard]] static Expected<std::unique_ptr<DynamicsWorld>> create(const state::WorldDescription& description,
                                                                       const state::WorldState& state);
  ~DynamicsWorld();
  DynamicsWorld(const DynamicsWorld&) = delete;
  DynamicsWorld& operator=(const DynamicsWorld&) = delete;

  /// Advances `state` by dt_s (> 0) seconds. `state` must be made from the description that this was made from.
  void step(state::WorldState& state, double dt_s) noexcept;

 private:
  struct Impl;
  explicit DynamicsWorld(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::dynamics
