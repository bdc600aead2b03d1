// Small worlds for the tests of dynamics: made of descriptions, as a scenario makes them.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/dynamics/dynamics_world.hpp"

namespace mechane::dynamics::test {

inline constexpr double kStep = 1e-3;

/// A free body, without gravity and without Bullet's damping.
inline state::BodyDescription body(const std::string& name, double mass_kg,
                                   const Vec3& inertia_kg_m2 = {0.01, 0.01, 0.01}) {
  state::BodyDescription out;
  out.name = name;
  out.mass_kg = mass_kg;
  out.inertia_kg_m2 = inertia_kg_m2.asDiagonal();
  out.use_gravity = false;
  out.linear_damping = 0;
  out.angular_damping = 0;
  return out;
}

inline state::BodyDescription fixed_body(const std::string& name) {
  state::BodyDescription out = body(name, 1);
  out.fixed = true;
  return out;
}

/// Between body 0 and body 1, whose frames are given.
inline state::JointDescription joint(state::JointKind kind, const Pose& X_B1J = {}, const Pose& X_B2J = {}) {
  state::JointDescription out;
  out.name = "JOINT";
  out.kind = kind;
  out.body1 = BodyId(0);
  out.body2 = BodyId(1);
  out.X_B1J = X_B1J;
  out.X_B2J = X_B2J;
  return out;
}

/// A world of a description, and its state.
struct Scene {
  state::WorldDescription description;
  std::unique_ptr<state::WorldState> state;
  std::unique_ptr<DynamicsWorld> world;

  explicit Scene(state::WorldDescription from) : description(std::move(from)) {
    state = std::make_unique<state::WorldState>(description);
    auto made = DynamicsWorld::create(description, *state);
    if (!made) throw std::runtime_error(made.error().to_string());
    world = std::move(*made);
  }
  void run(double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n)
      world->step(*state, kStep);
  }
  [[nodiscard]] state::BodyState& at(std::size_t i) { return state->bodies[i]; }
  [[nodiscard]] state::JointState& hinge() { return state->joints[0]; }
};

/// A fixed frame and a wheel on a hinge about W's z through the origin, with `inertia` about it.
inline state::WorldDescription wheel(double inertia_kg_m2) {
  state::WorldDescription out;
  out.bodies = {fixed_body("FRAME"), body("WHEEL", 2, {inertia_kg_m2, inertia_kg_m2, inertia_kg_m2})};
  out.joints = {joint(state::JointKind::hinge)};
  return out;
}

/// User 0 holds `held` at p_BG, its hand at X_WH, with the body where it is now.
inline void hold(Scene& scene, std::size_t held, const Vec3& p_BG, double force_n, double torque_nm) {
  state::UserState& user = scene.state->users[0];
  user.present = true;
  user.freshness = 1;
  const Pose& X_WB = scene.at(held).X_WB;
  user.X_WH = {X_WB * p_BG, Quat::Identity()};
  user.V_WH = {};
  user.grasp = {true, BodyId(held), user.X_WH.inverse() * X_WB, p_BG, force_n, torque_nm, {}};
}

}  // namespace mechane::dynamics::test
