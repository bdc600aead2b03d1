// The odometer's last drum: one pebble a hole, forwards only, and none from an empty hole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/machines/machine_bench.hpp"

namespace mechane::machines::test {
namespace {

constexpr int kHoles = 12;
constexpr double kTooth = 2 * kPi / kHoles;

state::WorldDescription counter_world() {
  state::WorldDescription world;
  const BodyId box = add_body(world, "CASE", 1, 1, true);
  add_joint(world, "DRUM", state::JointKind::hinge, box, add_body(world, "DISC", 3, 0.05, true));
  for (int i = 0; i < 3; ++i) {
    const BodyId stone = add_body(world, "PEBBLE" + std::to_string(i), 0.02, 1e-6);
    world.bodies[stone.index()].X_WB.p = Quat(Eigen::AngleAxisd(-i * kTooth, Vec3::UnitZ())) * Vec3(0.1, 0, 0);
  }
  world.machines = {{"COUNTER",
                     "machine.pebble_counter",
                     {{"joint", text("DRUM")},
                      {"holes", number(kHoles)},
                      {"distancePerPebble", number(20)},
                      {"stones", std::vector<std::string>{"PEBBLE0", "PEBBLE1", "PEBBLE2"}}},
                     11}};
  return world;
}

void turn_to(Bench& bench, double angle) {
  bench.body("DISC").X_WB.R = Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()));
  bench.move_to(angle);
}

TEST(PebbleCounter, APebbleATooth) {
  Bench bench(counter_world());
  EXPECT_EQ(bench.value("COUNTER.left"), kHoles);
  for (int teeth = 1; teeth <= 5; ++teeth) {
    turn_to(bench, kTooth * (teeth - 0.55));
    EXPECT_EQ(bench.value("COUNTER.pebbles"), teeth - 1);
    turn_to(bench, kTooth * teeth);
    EXPECT_EQ(bench.value("COUNTER.pebbles"), teeth);
    EXPECT_EQ(bench.value("COUNTER.distance_m"), 20 * teeth);
    EXPECT_EQ(bench.value("COUNTER.left"), kHoles - teeth);
  }
}

TEST(PebbleCounter, RunsOutWithItsPebbles) {
  Bench bench(counter_world());
  turn_to(bench, 2 * kPi * 3);
  EXPECT_EQ(bench.value("COUNTER.pebbles"), kHoles);
  EXPECT_EQ(bench.value("COUNTER.left"), 0);
}

TEST(PebbleCounter, ADrumThatIsNotThereCountsNothing) {
  Bench bench(counter_world());
  bench.joint().enabled = false;
  turn_to(bench, 3);
  EXPECT_EQ(bench.value("COUNTER.pebbles"), 0);
}

RC_GTEST_PROP(PebbleCounter, CountsTheFarthestForwardAndNothingBack, ()) {
  Bench bench(counter_world());
  double farthest = 0, at = 0;
  for (int i = 0; i < 30; ++i) {
    at += 0.01 * *rc::gen::inRange(-120, 130);
    turn_to(bench, at);
    farthest = std::max(farthest, at);
    RC_ASSERT(bench.value("COUNTER.pebbles") == std::clamp(std::floor(farthest / kTooth + 0.5), 0.0, double{kHoles}));
  }
}

TEST(PebbleCounter, PebblesRideInTheDrumUntilTheyFallOneByOne) {
  Bench bench(counter_world(), Bench::Moved::by_dynamics);
  const auto ride = [&](double angle) {
    turn_to(bench, angle);
    bench.tick();
  };
  ride(0.2);
  EXPECT_NEAR(bench.body("PEBBLE0").X_WB.p.y(), 0.1 * std::sin(0.2), 1e-9) << "it went with the drum";
  EXPECT_FALSE(bench.body("PEBBLE0").movable);
  for (int n = 0; n < 300; ++n)
    ride(kTooth * 0.6);
  EXPECT_TRUE(bench.body("PEBBLE0").movable);
  EXPECT_FALSE(bench.body("PEBBLE1").movable);
  EXPECT_NEAR(bench.body("PEBBLE0").X_WB.p.y(), 0.1 * std::sin(kTooth * 0.6) - 0.5 * 9.81 * 0.36, 0.05)
      << "0.6 s of fall";
  ride(kTooth * 1.6);
  EXPECT_TRUE(bench.body("PEBBLE1").movable);
  EXPECT_FALSE(bench.body("PEBBLE2").movable);
}

TEST(PebbleCounter, ATickAllocatesNothing) {
  Bench bench(counter_world());
  EXPECT_EQ(bench.allocations(10000), 0u);
}

TEST(PebbleCounter, ErrorsSayWhatToWrite) {
  state::WorldDescription world = counter_world();
  world.machines[0].parameters["holes"] = number(2);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("stones"), {"2 holes"}));
  world = counter_world();
  world.machines[0].parameters["stones"] = text("CASE");
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::conflict, line_of("stones"), {"machine.pebble_counter COUNTER", "'CASE'"}));
}

}  // namespace
}  // namespace mechane::machines::test
