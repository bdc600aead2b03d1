// A small world for the tests of agents: no dynamics, the tests move bodies and hands themselves.
#pragma once

#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/agents/agent_set.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/parameter_lines.hpp"

namespace mechane::agents::test {

inline constexpr double kStep = 1e-3;

inline state::Parameter text(std::initializer_list<std::string> values) {
  return std::vector<std::string>(values);
}
inline state::Parameter number(std::initializer_list<double> values) {
  return std::vector<double>(values);
}

/// FRAME (fixed), PART and CRANK (graspable), and AXLE, a hinge between FRAME and CRANK.
inline state::WorldDescription stage_world() {
  state::WorldDescription world;
  for (const char* name : {"FRAME", "PART", "CRANK"}) {
    state::BodyDescription body;
    body.name = name;
    body.fixed = world.bodies.empty();
    body.graspable = !body.fixed;
    world.bodies.push_back(body);
  }
  world.bodies[1].X_WB.p = Vec3(1, 0, 0);
  state::JointDescription axle;
  axle.name = "AXLE";
  axle.body1 = BodyId(0);
  axle.body2 = BodyId(2);
  world.joints = {axle};
  return world;
}

/// A world with its agents, run tick by tick.
struct Stage {
  state::WorldDescription world;
  state::MemoryLayout layout;
  std::unique_ptr<AgentSet> agents;
  std::unique_ptr<state::WorldState> state;
  std::vector<state::Event> events;  ///< of all ticks since they were last cleared

  explicit Stage(state::WorldDescription from) : world(std::move(from)) {
    auto made = AgentSet::create(world, layout);
    if (!made) throw std::runtime_error(made.error().to_string());
    agents = std::move(*made);
    state = std::make_unique<state::WorldState>(world);
    state->memory = layout.initial();
    agents->start(*state);
    keep_events();
  }
  void tick(std::vector<state::Command> commands = {}) {
    ++state->tick;
    state->event_count = 0;
    agents->run(*state, commands, kStep);
    keep_events();
  }
  void run(double seconds) {
    for (int n = static_cast<int>(std::lround(seconds / kStep)); n > 0; --n)
      tick();
  }
  [[nodiscard]] double value(const std::string& name) const { return state->memory[layout.find(name)->index]; }
  /// How many events of this kind; `last` gets the last of them.
  [[nodiscard]] int count(state::EventKind kind, state::Event* last = nullptr) const {
    int found = 0;
    for (const state::Event& event : events) {
      if (event.kind != kind) continue;
      ++found;
      if (last != nullptr) *last = event;
    }
    return found;
  }
  [[nodiscard]] state::UserState& user(std::size_t u = 0) const { return state->users[u]; }

  /// A hand appears at p_WH, open.
  void appear(std::size_t u, hand::HandKind kind, const Vec3& p_WH = Vec3::Zero()) const {
    user(u) = {};
    user(u).present = true;
    user(u).freshness = 1;
    user(u).sample.kind = kind;
    user(u).X_WH.p = p_WH;
  }
  void touch(std::size_t u, BodyId body, std::uint8_t segment, const Vec3& n_BH_W,
             const Vec3& p_WC = Vec3::Zero()) const {
    user(u).contacts[user(u).contact_count++] = {body, segment, p_WC, n_BH_W, 1e-3};
  }
  void lift_off(std::size_t u = 0) const { user(u).contact_count = 0; }

 private:
  void keep_events() {
    const auto now = state->event_span();
    events.insert(events.end(), now.begin(), now.end());
  }
};

using mechane::test::is_error;
using mechane::test::line_of;

/// The error of making a set from `world`, whose parameters get the lines that line_of() tells; empty where it works.
inline Error error_of(state::WorldDescription world) {
  mechane::test::number_lines(world.agents);
  state::MemoryLayout layout;
  auto made = AgentSet::create(world, layout);
  return made ? Error{} : made.error();
}

}  // namespace mechane::agents::test
