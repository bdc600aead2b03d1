// Which edits of a scenario a world that runs can go on with.
#include "server/world/continuation.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "server/state/snapshot.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"

namespace mechane::world {
namespace {

using Kind = Obstacle::Kind;
using state::WorldDescription;

const WorldConfig& world_config() {
  static const WorldConfig kConfig{test::shared_hand(), {}};
  return kConfig;
}

std::shared_ptr<WorldDescription> edited(const std::function<void(WorldDescription&)>& edit) {
  auto next = test::make_crank_description();
  edit(*next);
  return next;
}

Obstacle obstacle_to(const std::function<void(WorldDescription&)>& edit) {
  const auto obstacle = obstacle_between(test::make_crank_description(), edited(edit), world_config());
  EXPECT_TRUE(obstacle) << (obstacle ? "" : obstacle.error().to_string());
  return obstacle ? *obstacle : Obstacle{};
}

TEST(Continuation, WhatTouchFeelsMassesRulesAndTextsMayChange) {
  const auto edit = [](WorldDescription& world) {
    world.bodies[1].haptic.stiffness_n_per_m = 900;
    world.bodies[1].mass_kg = 3;
    world.gravity_W.y() = -5;
    world.agents[0].parameters["frictionTorque"] = std::vector<double>{0.1};
    world.quantities[0].unit = "turns";
    world.steps[0].triggers[0].value = 4;
    world.steps[0].texts["caption"]["en"] = "Turn it.";
    world.viewpoints.emplace_back();
  };
  EXPECT_EQ(obstacle_to(edit).kind, Kind::none);

  // The state of one that has run is a state of the other, which goes on.
  auto now = World::create(test::make_crank_description(), world_config());
  ASSERT_TRUE(now);
  NoPublisher publisher;
  SystemClock clock;
  PhaseTimer timer(clock);
  for (int i = 0; i < 100; ++i)
    step(**now, {}, publisher, timer);
  std::vector<std::byte> snapshot;
  state::write_snapshot((*now)->state, snapshot);
  const auto next = World::resume(edited(edit), world_config(), snapshot);
  ASSERT_TRUE(next) << next.error().to_string();
  EXPECT_EQ((*next)->state.tick, 100U);
}

TEST(Continuation, WhatBeginsOtherwiseOrSwitchesOtherThingsIsNamed) {
  const auto expect = [](const std::function<void(WorldDescription&)>& edit, Kind kind, const std::string& name) {
    const Obstacle obstacle = obstacle_to(edit);
    EXPECT_EQ(word_of(obstacle.kind), word_of(kind));
    EXPECT_EQ(obstacle.name, name);
  };
  expect([](auto& world) { world.bodies[1].X_WB.p.x() = 1e-9; }, Kind::body, "CRANK");
  expect([](auto& world) { world.bodies[1].graspable = false; }, Kind::body, "CRANK");
  expect([](auto& world) { world.bodies[0].name = "POST"; }, Kind::bodies, "");
  expect([](auto& world) { world.bodies.push_back(world.bodies[0]); }, Kind::bodies, "");
  expect([](auto& world) { world.steps[0].name = "wind"; }, Kind::steps, "");
  expect([](auto& world) { world.activities[0].name = "play"; }, Kind::steps, "");
  expect([](auto& world) { world.steps[0].disable = {AgentId(1)}; }, Kind::steps, "turn");
  expect([](auto& world) { world.steps[0].bodies = {{BodyId(1), false, {}, {}, {}, {}}}; }, Kind::steps, "turn");
  expect([](auto& world) { world.joints[0].enabled_at_start = false; }, Kind::start, "");
  expect([](auto& world) { world.agents.pop_back(), world.quantities.pop_back(); }, Kind::start, "");
}

TEST(Continuation, AWorldThatCannotBeMadeIsAnError) {
  const auto broken = edited([](WorldDescription& world) { world.agents[0].type = "geometry.rose"; });
  EXPECT_FALSE(obstacle_between(test::make_crank_description(), broken, world_config()));
}

}  // namespace
}  // namespace mechane::world
