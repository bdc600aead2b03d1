// A world of a few bodies and joints for one machine under test. Joints are moved by hand, or by the dynamics.
#pragma once

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "server/dynamics/dynamics_world.hpp"
#include "server/machines/machine_set.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/parameter_lines.hpp"

namespace mechane::machines::test {

inline constexpr double kTick = 1e-3;

inline state::Parameter number(double x) {
  return std::vector<double>{x};
}
inline state::Parameter text(std::string x) {
  return std::vector<std::string>{std::move(x)};
}
inline state::Parameter vector(double x, double y, double z) {
  return std::vector<double>{x, y, z};
}

inline BodyId add_body(state::WorldDescription& world, const std::string& name, double mass_kg, double inertia_kg_m2,
                       bool fixed = false) {
  state::BodyDescription body;
  body.name = name;
  body.mass_kg = mass_kg;
  body.inertia_kg_m2 = inertia_kg_m2 * Mat3::Identity();
  body.fixed = fixed;
  body.linear_damping = 0;
  body.angular_damping = 0;
  body.effort_scale = world.effort_scale;
  world.bodies.push_back(body);
  return BodyId(world.bodies.size() - 1);
}

inline void add_joint(state::WorldDescription& world, const std::string& name, state::JointKind kind, BodyId body1,
                      BodyId body2) {
  state::JointDescription joint;
  joint.name = name;
  joint.kind = kind;
  joint.body1 = body1;
  joint.body2 = body2;
  world.joints.push_back(joint);
}

inline void add_quantity(state::WorldDescription& world, const std::string& name) {
  world.quantities.push_back({name, name, ""});
}

using mechane::test::is_error;
using mechane::test::line_of;

/// The error of making and linking the machines of a world without agents' slots, whose parameters get the lines that line_of() tells;
/// empty where there is none.
inline Error error_of(state::WorldDescription world) {
  mechane::test::number_lines(world.machines);
  state::MemoryLayout layout;
  auto made = MachineSet::create(world, layout);
  if (!made) return made.error();
  auto linked = (*made)->link(layout);
  return linked ? Error{} : linked.error();
}

class Bench {
 public:
  enum class Moved { by_hand, by_dynamics };

  /// `slots_of_agents`, as "FIRE.lit", are given out after the machines', as a world does it.
  explicit Bench(state::WorldDescription from, Moved moved = Moved::by_hand,
                 const std::vector<std::string>& slots_of_agents = {})
      : world(std::move(from)) {
    auto made = MachineSet::create(world, layout_);
    if (!made) throw std::runtime_error(made.error().to_string());
    machines_ = std::move(*made);
    for (const std::string& slot : slots_of_agents)
      layout_.add(slot.substr(0, slot.find('.')), slot.substr(slot.find('.') + 1));
    if (auto linked = machines_->link(layout_); !linked) throw std::runtime_error(linked.error().to_string());
    state = std::make_unique<state::WorldState>(world);
    state->memory = layout_.initial();
    for (state::JointState& joint : state->joints)
      joint.enabled = true;
    if (moved == Moved::by_hand) return;
    auto dynamics = dynamics::DynamicsWorld::create(world, *state);
    if (!dynamics) throw std::runtime_error(dynamics.error().to_string());
    dynamics_ = std::move(*dynamics);
  }

  [[nodiscard]] double value(const std::string& name) const { return state->memory.at(layout_.find(name)->index); }
  [[nodiscard]] double& value_of_agent(const std::string& name) { return state->memory.at(layout_.find(name)->index); }
  [[nodiscard]] double& quantity(const std::string& name) {
    return state->quantities.at(world.find_quantity(name).index());
  }
  [[nodiscard]] state::JointState& joint(std::size_t i = 0) { return state->joints.at(i); }
  [[nodiscard]] state::BodyState& body(const std::string& name) {
    return state->bodies.at(world.find_body(name).index());
  }

  /// What machines write stays to be looked at, unless the dynamics use it up.
  void tick() {
    state->event_count = 0;
    for (state::JointState& joint : state->joints)
      joint.load = joint.resistance = 0;
    for (state::BodyState& body : state->bodies)
      body.load_W = {};
    machines_->run(*state, kTick);
    if (dynamics_) dynamics_->step(*state, kTick);
    ++state->tick;
  }
  void run(double seconds) {
    for (long n = std::lround(seconds / kTick); n > 0; --n)
      tick();
  }
  /// Moves a joint there within this tick.
  void move_to(double position, std::size_t i = 0) {
    joint(i).velocity = (position - joint(i).position) / kTick;
    joint(i).position = position;
    tick();
  }
  /// Puts a joint there, at rest.
  void hold_at(double position, std::size_t i = 0) {
    joint(i).velocity = 0;
    joint(i).position = position;
    tick();
  }
  /// Allocations of `ticks` ticks of the machines alone; 0 where this build cannot count.
  [[nodiscard]] std::uint64_t allocations(int ticks) {
    const mechane::test::AllocationGuard guard;
    for (int n = 0; n < ticks; ++n) {
      state->joints.front().position += 1e-4;
      machines_->run(*state, kTick);
    }
    return mechane::test::AllocationGuard::available() ? guard.allocations() : 0;
  }

  state::WorldDescription world;
  std::unique_ptr<state::WorldState> state;

 private:
  state::MemoryLayout layout_;
  std::unique_ptr<MachineSet> machines_;
  std::unique_ptr<dynamics::DynamicsWorld> dynamics_;
};

}  // namespace mechane::machines::test
