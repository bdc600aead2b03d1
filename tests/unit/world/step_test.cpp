#include "server/world/step.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "server/state/snapshot.hpp"
#include "server/state/world_state.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/scripted_hand.hpp"

namespace mechane::world {
namespace {

using state::EventKind;
using state::TickInputs;
using state::WorldState;

const Pose kAxis;
const Vec3 kGrip(test::kCrankRadiusM, 0, 0);
// Past the end of the handle along the axis: a hand beside it in the plane of the circle would meet it after a turn.
const Vec3 kBeside(0, 0, 0.065 + 0.05);

/// Counts what it was told, and keeps the events.
class Watch final : public Publisher {
 public:
  void publish_forces(const WorldState& state) noexcept override { early = state.users[0].output; }
  void publish(const WorldState& state) noexcept override {
    ++ticks;
    const auto& now = state.users[0].output;
    if (now.force_W.f != early.force_W.f || now.force_W.t != early.force_W.t || now.holding != early.holding)
      ++late_changes;
    for (const state::Event& event : state.event_span())
      counts[static_cast<std::size_t>(event.kind)] += 1;
    const Vec3& f = state.users[0].output.force_W.f;
    force_max_n = std::max(force_max_n, f.norm());
  }
  [[nodiscard]] int count(EventKind kind) const { return counts[static_cast<std::size_t>(kind)]; }

  std::uint64_t ticks = 0;
  std::uint64_t late_changes = 0;  // outputs that a device would not have got
  decltype(state::UserState::output) early;
  std::array<int, 32> counts{};
  double force_max_n = 0;
};

class Stage {
 public:
  explicit Stage(double stiffness_n_per_m = 600) {
    WorldConfig config;
    config.hand = test::shared_hand();
    auto made = World::create(test::make_crank_description(stiffness_n_per_m), config);
    if (!made) throw std::runtime_error(made.error().to_string());
    world = std::move(*made);
  }
  void step(const TickInputs& inputs) { world::step(*world, inputs, watch, timer); }
  void play(const test::ScriptedHand& hand, std::uint64_t first, std::uint64_t ticks) {
    for (std::uint64_t t = first; t < first + ticks; ++t) {
      TickInputs inputs;
      inputs.users[0] = hand.sample(t);
      step(inputs);
    }
  }
  [[nodiscard]] double turns() const { return world->state.joints[0].position / (2 * kPi); }

  std::unique_ptr<World> world;
  SystemClock clock;
  PhaseTimer timer{clock};
  Watch watch;
};

TEST(Step, AHandThatHoldsTheHandleTurnsTheCrankAndFeelsIt) {
  Stage stage;
  stage.play({kGrip, kAxis, 2 * kPi}, 0, 4000);
  EXPECT_EQ(stage.watch.count(EventKind::grasped), 1);
  EXPECT_GT(stage.turns(), 2.5);
  EXPECT_GT(stage.watch.force_max_n, 0.05);
  EXPECT_EQ(stage.watch.count(EventKind::activity_done), 1);
}

TEST(Step, ForcesThatLeftEarlyAreThoseOfTheTicksEnd) {
  Stage stage;
  stage.play({kGrip, kAxis, 2 * kPi}, 0, 4000);
  EXPECT_EQ(stage.watch.ticks, 4000U);
  EXPECT_EQ(stage.watch.late_changes, 0U);
  EXPECT_GT(stage.watch.early.echo_sequence, 0U);
}

TEST(Step, TheHalvesOfTwoWorldsInTurnGiveTheBitsOfEach) {
  const std::array<test::ScriptedHand, 2> hands{test::ScriptedHand(kGrip, kAxis, 2 * kPi),
                                                test::ScriptedHand(kGrip, kAxis, 3)};
  std::array<Stage, 2> in_turn, alone;
  std::array<TickInputs, 2> inputs;
  for (std::uint64_t t = 0; t < 2000; ++t) {
    for (std::size_t i = 0; i < 2; ++i) {
      inputs[i].users[0] = hands[i].sample(t);
      alone[i].step(inputs[i]);
      feel(*in_turn[i].world, inputs[i], in_turn[i].watch, in_turn[i].timer);
      EXPECT_EQ(in_turn[i].watch.ticks, t);
    }
    for (Stage& stage : in_turn)
      move(*stage.world, stage.watch, stage.timer);
  }
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(state::state_hash(in_turn[i].world->state), state::state_hash(alone[i].world->state));
  EXPECT_GT(in_turn[0].turns(), 0.5);
}

TEST(Step, TheSameVisitFiveCentimetresBesideTurnsNothing) {
  Stage stage;
  stage.play({kGrip, kAxis, 2 * kPi, kBeside}, 0, 4000);
  EXPECT_EQ(stage.watch.count(EventKind::grasped), 0);
  EXPECT_EQ(stage.turns(), 0);
  EXPECT_EQ(stage.watch.force_max_n, 0);
}

TEST(Step, TheSameVisitWithoutStiffnessTurnsNothing) {
  Stage stage(0);
  stage.play({kGrip, kAxis, 2 * kPi}, 0, 4000);
  EXPECT_NEAR(stage.turns(), 0, 1e-6);
  EXPECT_EQ(stage.watch.force_max_n, 0);
}

TEST(Step, SameInputsGiveTheSameBits) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  Stage first;
  Stage second;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  for (std::uint64_t t = 0; t < 10'000; t += 1000) {
    first.play(hand, t, 1000);
    second.play(hand, t, 1000);
    ASSERT_EQ(state::state_hash(first.world->state), state::state_hash(second.world->state))
        << "after tick " << t + 1000;
  }
  Stage other;
  other.play({kGrip, kAxis, 5.000001}, 0, 10'000);
  EXPECT_NE(state::state_hash(first.world->state), state::state_hash(other.world->state));
}

TEST(Step, TicksAllocateNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Stage stage;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  std::vector<TickInputs> inputs(10'000);
  for (std::uint64_t t = 0; t < inputs.size(); ++t)
    inputs[t].users[0] = hand.sample(t);
  const test::AllocationGuard guard;
  for (const TickInputs& input : inputs)
    stage.step(input);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
}

TEST(Step, WhenSamplesStopForcesAreHeldTenMillisecondsAndGoneAfterFifty) {
  Stage stage;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  stage.play(hand, 0, 1500);
  const double held_n = stage.world->state.users[0].output.force_W.f.norm();
  ASSERT_GT(held_n, 0.01);
  const double rate = stage.world->state.joints[0].velocity;
  for (int age_ms = 1; age_ms <= 60; ++age_ms) {
    TickInputs inputs;
    inputs.users[0] = hand.sample(1499);
    inputs.users[0].fresh = false;
    inputs.users[0].age = std::chrono::milliseconds(age_ms);
    stage.step(inputs);
    const state::UserState& user = stage.world->state.users[0];
    if (age_ms >= 50) {
      EXPECT_EQ(user.output.force_W.f.norm(), 0) << age_ms;
      EXPECT_EQ(user.grasp.reaction_W.f.norm(), 0) << "the body must not be held either";
    }
    if (age_ms <= 10) {
      EXPECT_EQ(user.freshness, 1) << age_ms;
    }
  }
  EXPECT_EQ(stage.watch.count(EventKind::input_stale), 1);
  EXPECT_LE(std::abs(stage.world->state.joints[0].velocity), std::abs(rate) + 0.1);
}

TEST(Step, AJumpOfAMetreLetsGoAndPushesNobody) {
  Stage stage;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  stage.play(hand, 0, 1500);
  ASSERT_TRUE(stage.world->state.users[0].grasp.active);
  TickInputs inputs;
  inputs.users[0] = hand.sample(1500);
  inputs.users[0].sample.X_WH.p += Vec3(1, 0, 0);
  stage.step(inputs);
  EXPECT_FALSE(stage.world->state.users[0].grasp.active);
  EXPECT_EQ(stage.world->state.users[0].output.force_W.f.norm(), 0);
  EXPECT_EQ(stage.watch.count(EventKind::released), 1);
}

TEST(Step, AUserWhoLeavesLetsGo) {
  Stage stage;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  stage.play(hand, 0, 1500);
  stage.step(TickInputs{});
  EXPECT_FALSE(stage.world->state.users[0].present);
  EXPECT_FALSE(stage.world->state.users[0].grasp.active);
  EXPECT_EQ(stage.watch.count(EventKind::user_left), 1);
}

TEST(World, AMachineReadsWhatAnAgentSays) {
  const auto text = [](const char* value) { return std::vector<std::string>{value}; };
  const auto number = [](double value) { return std::vector<double>{value}; };
  state::WorldDescription world = *test::make_crank_description();
  world.agents.push_back({"FIRE", "simulation.lit", {{"body", text("CRANK")}, {"flame", text("FRAME")}}, 3});
  world.machines = {{"STEAM",
                     "machine.steam_sphere",
                     {{"joint", text("AXLE")},
                      {"litBy", text("FIRE")},
                      {"firePower", number(1000)},
                      {"timeScale", number(60)},
                      {"nozzleRadius", number(0.1)},
                      {"nozzleDiameter", number(0.003)}},
                     5}};
  world.quantities.push_back({"warmth", "STEAM.temperature_c", ""});
  WorldConfig config;
  config.hand = test::shared_hand();
  auto made = World::create(std::make_shared<state::WorldDescription>(world), config);
  ASSERT_TRUE(made) << made.error().to_string();
  NoPublisher nobody;
  SystemClock clock;
  PhaseTimer timer(clock);
  const auto warmth_after = [&](int ticks) {
    for (int n = 0; n < ticks; ++n)
      step(**made, TickInputs{}, nobody, timer);
    return (*made)->state.quantities.back();
  };
  EXPECT_EQ(warmth_after(450), 20) << "the flame is there for half a second before it lights";
  EXPECT_GT(warmth_after(100), 20.5);

  world.agents.back().type = "simulation.idle";
  world.agents.back().parameters.clear();
  const auto wrong = World::create(std::make_shared<state::WorldDescription>(world), config);
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, ErrorCode::invalid_value);
  EXPECT_EQ(wrong.error().line, 5);
  EXPECT_EQ(wrong.error().where, "line 5, machine.steam_sphere STEAM");
  EXPECT_FALSE(wrong.error().remedy.empty());
}

TEST(World, ResumesFromASnapshotWhereItWas) {
  Stage stage;
  const test::ScriptedHand hand(kGrip, kAxis, 5);
  stage.play(hand, 0, 1500);
  std::vector<std::byte> snapshot;
  state::write_snapshot(stage.world->state, snapshot);
  WorldConfig config;
  config.hand = test::shared_hand();
  auto resumed = World::resume(test::make_crank_description(), config, snapshot);
  ASSERT_TRUE(resumed) << resumed.error().to_string();
  EXPECT_EQ((*resumed)->state.joints[0].position, stage.world->state.joints[0].position);
  EXPECT_EQ((*resumed)->state.tick, stage.world->state.tick);
  EXPECT_FALSE((*resumed)->state.users[0].present);
}

}  // namespace
}  // namespace mechane::world
