// A world with its agents and its dynamics: what geometry agents ask for happens.
#pragma once

#include "server/dynamics/dynamics_world.hpp"
#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {

/// FRAME (fixed), then a wheel for each inertia, on hinges HINGE0, HINGE1 ... about W's z, 1 m apart along x.
inline state::WorldDescription wheel_world(const std::vector<double>& inertias_kg_m2) {
  state::WorldDescription world;
  state::BodyDescription frame;
  frame.name = "FRAME";
  frame.fixed = true;
  world.bodies = {frame};
  for (std::size_t i = 0; i < inertias_kg_m2.size(); ++i) {
    state::BodyDescription wheel;
    wheel.name = "WHEEL" + std::to_string(i);
    wheel.inertia_kg_m2 = Mat3::Identity() * inertias_kg_m2[i];
    wheel.use_gravity = false;
    wheel.linear_damping = wheel.angular_damping = 0;
    wheel.graspable = true;
    wheel.X_WB.p = Vec3(static_cast<double>(i), 0, 0);
    state::JointDescription hinge;
    hinge.name = "HINGE" + std::to_string(i);
    hinge.body1 = BodyId(0);
    hinge.body2 = BodyId(world.bodies.size());
    hinge.X_B1J.p = wheel.X_WB.p;
    world.bodies.push_back(wheel);
    world.joints.push_back(hinge);
  }
  return world;
}

/// A free body with gravity.
inline BodyId add_block(state::WorldDescription& world, const std::string& name, double mass_kg, const Vec3& p) {
  state::BodyDescription block;
  block.name = name;
  block.mass_kg = mass_kg;
  block.inertia_kg_m2 = Mat3::Identity() * 0.01 * mass_kg;
  block.linear_damping = block.angular_damping = 0;
  block.graspable = true;
  block.X_WB.p = p;
  world.bodies.push_back(block);
  return BodyId(world.bodies.size() - 1);
}

struct MachineStage : Stage {
  std::unique_ptr<dynamics::DynamicsWorld> dynamics;

  explicit MachineStage(state::WorldDescription from) : Stage(std::move(from)) {
    auto made = dynamics::DynamicsWorld::create(world, *state);
    if (!made) throw std::runtime_error(made.error().to_string());
    dynamics = std::move(*made);
  }
  void step(const std::vector<state::Command>& commands = {}) {
    tick(commands);
    dynamics->step(*state, kStep);
  }
  void run_machine(double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n)
      step();
  }
  /// With a torque, N m, on a joint.
  void run_loaded(double seconds, std::size_t joint, double load) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n) {
      tick();
      state->joints[joint].load = load;
      dynamics->step(*state, kStep);
    }
  }
};

/// A geometry or simulation agent of a test.
inline state::ComponentDescription agent(const std::string& name, const std::string& type,
                                         std::map<std::string, state::Parameter> parameters) {
  return {name, type, std::move(parameters), 9};
}

}  // namespace mechane::agents::test
