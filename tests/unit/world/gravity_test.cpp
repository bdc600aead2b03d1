// Steps give bodies their weight and take it: how they move then, and what is hashed and saved of it.
#include <gtest/gtest.h>

#include "server/base/clock.hpp"
#include "server/state/snapshot.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/floating_ball.hpp"

namespace mechane::world {
namespace {

constexpr double kG = 9.81;

class Falling {
 public:
  explicit Falling(bool by_step = true) : Falling(test::make_floating_ball(by_step), {}) {}
  Falling(std::shared_ptr<const state::WorldDescription> description, std::span<const std::byte> snapshot)
      : world_(std::move(snapshot.empty() ? World::create(description, config())
                                          : World::resume(description, config(), snapshot))
                   .value()) {}

  void run_to(std::uint64_t tick) {
    SystemClock clock;
    PhaseTimer timer(clock);
    NoPublisher publisher;
    while (world_->state.tick < tick)
      step(*world_, {}, publisher, timer);
  }
  void restart() {
    SystemClock clock;
    PhaseTimer timer(clock);
    NoPublisher publisher;
    state::TickInputs inputs;
    inputs.commands[0] = {1, state::CommandKind::restart_activity};
    inputs.command_count = 1;
    step(*world_, inputs, publisher, timer);
  }
  /// To the end of the first tick in which this step has begun.
  std::uint64_t run_into(std::size_t wanted) {
    while (world_->state.progress.step != StepId(wanted) && world_->state.tick < 5000)
      run_to(world_->state.tick + 1);
    EXPECT_EQ(world_->state.progress.step, StepId(wanted));
    return world_->state.tick;
  }
  state::WorldState& state() { return world_->state; }
  [[nodiscard]] Vec3 p_W(std::size_t body) const { return world_->state.bodies[body].X_WB.p; }
  [[nodiscard]] Vec3 v_W(std::size_t body) const { return world_->state.bodies[body].V_WB.v; }

 private:
  static WorldConfig config() {
    WorldConfig config;
    config.hand = test::shared_hand();
    return config;
  }
  std::unique_ptr<World> world_;
};

TEST(GravityByStep, ABodyFloatsAndThenFallsByTheClosedForm) {
  Falling world;
  const std::uint64_t began = world.run_into(1);
  EXPECT_NEAR(static_cast<double>(began) * kTickSeconds, test::kFloats_s, 2 * kTickSeconds);
  const double moved_m = (world.p_W(0) - test::kBall_W).norm();
  EXPECT_LE(moved_m, 1.001 * kG * kTickSeconds * kTickSeconds) << "it has not fallen for more than this tick";
  for (const std::uint64_t ticks : {100u, 400u, 800u}) {
    world.run_to(began + ticks);
    const double t_s = static_cast<double>(ticks) * kTickSeconds;
    const Vec3 fallen = world.p_W(0) - test::kBall_W;
    EXPECT_NEAR(fallen.y(), -kG * t_s * t_s / 2, 2 * kG * t_s * kTickSeconds) << "to within two ticks' way";
    EXPECT_NEAR(world.v_W(0).y(), -kG * t_s, 2 * kG * kTickSeconds);
    EXPECT_EQ(fallen.x(), 0);
  }
}

TEST(GravityByStep, AStoneThatFallsGoesOnAtItsSpeedOnceItHasNoWeight) {
  Falling world;
  const std::uint64_t began = world.run_into(1);
  const double v = world.v_W(1).y(), y = world.p_W(1).y();
  EXPECT_NEAR(v, -kG * test::kFloats_s, 2 * kG * kTickSeconds);
  world.run_to(began + 500);
  EXPECT_NEAR(world.v_W(1).y(), v, kG * kTickSeconds);
  EXPECT_NEAR(world.p_W(1).y(), y + 0.5 * v, 0.5 * kG * kTickSeconds + 1e-6);
}

TEST(GravityByStep, LaterStepsKeepItAndARestartPutsItBack) {
  Falling world;
  const std::uint64_t began = world.run_into(2);
  EXPECT_TRUE(world.state().bodies[0].use_gravity);
  EXPECT_FALSE(world.state().bodies[1].use_gravity);
  const double v = world.v_W(0).y();
  world.run_to(began + 100);
  EXPECT_NEAR(world.v_W(0).y(), v - 0.1 * kG, 1e-6) << "the last step says nothing of it";
  world.restart();
  EXPECT_FALSE(world.state().bodies[0].use_gravity);
  EXPECT_TRUE(world.state().bodies[1].use_gravity);
  world.run_to(world.state().tick + 100);
  EXPECT_EQ(world.p_W(0), test::kBall_W) << "it floats again";
}

TEST(GravityByStep, ASnapshotKeepsIt) {
  Falling world;
  const std::uint64_t began = world.run_into(1);
  world.run_to(began + 150);
  std::vector<std::byte> bytes;
  state::write_snapshot(world.state(), bytes);
  Falling resumed(test::make_floating_ball(), bytes);
  EXPECT_TRUE(resumed.state().bodies[0].use_gravity);
  EXPECT_FALSE(resumed.state().bodies[1].use_gravity);
  for (const std::uint64_t later : {1u, 200u, 700u}) {
    world.run_to(began + 150 + later);
    resumed.run_to(began + 150 + later);
    EXPECT_EQ(state::state_hash(resumed.state()), state::state_hash(world.state())) << later;
  }
}

TEST(GravityByStep, TheHashHasItWhereStepsChangeItAndOnlyThere) {
  Falling changing;
  const std::uint64_t before = state::state_hash(changing.state());
  EXPECT_NE(before, state::state_hash(changing.state(), state::StateVersion::with_direct_joints));
  changing.state().bodies[0].use_gravity = true;
  EXPECT_NE(state::state_hash(changing.state()), before);
  // Other worlds have the hashes that they had.
  Falling constant(false);
  constant.run_to(300);
  EXPECT_EQ(state::state_hash(constant.state()),
            state::state_hash(constant.state(), state::StateVersion::with_direct_joints));
}

}  // namespace
}  // namespace mechane::world
