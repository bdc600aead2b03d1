#include "client-sdk/haptic/wall_test.hpp"

#include <gtest/gtest.h>

#include "client-sdk/haptic/simulated_stylus.hpp"

namespace mechane::haptic {
namespace {

TEST(WallTest, IsAGentleFloorThatStaysAtRest) {
  SimulatedStylus stylus({.hand = ArmConfig{}});
  auto wall = WallTest::make(stylus, 0);
  ASSERT_TRUE(wall);
  double largest_n = 0;
  for (int i = 0; i < 4000; ++i) {
    if (i == 1000) stylus.intend(Vec3(0, -0.014, 0));
    wall->tick(kTickPeriod);
    largest_n = std::max(largest_n, wall->report().force_n);
  }
  EXPECT_LE(largest_n, 1.0);
  EXPECT_NEAR(wall->report().force_n, 0.6, 0.1) << "against 600 N/m of the arm";
  EXPECT_NEAR(stylus.p_WH().y(), -0.013, 0.001);
  EXPECT_LT(wall->report().energy_out_j, 0.001);
}

TEST(WallTest, LetsGoOfTheHandByARamp) {
  SimulatedStylus stylus({.hand = ArmConfig{}});
  auto wall = WallTest::make(stylus, 0);
  ASSERT_TRUE(wall);
  stylus.intend(Vec3(0, 0, 0));
  for (int i = 0; i < 4000; ++i) {
    if (i == 1000) stylus.intend(Vec3(0, -0.014, 0));
    wall->tick(kTickPeriod);
  }
  ASSERT_FALSE(wall->rests());
  double before_n = wall->report().force_n, steepest_n = 0;
  int ticks = 0;
  for (; !wall->rests() && ticks < 1000; ++ticks) {
    wall->tick(kTickPeriod, false);
    steepest_n = std::max(steepest_n, before_n - wall->report().force_n);
    before_n = wall->report().force_n;
  }
  EXPECT_GT(ticks, 10);
  EXPECT_LT(ticks, 1000);
  EXPECT_LT(steepest_n, 0.1);
}

/// A glove whose fingers close, and that is let go.
class ClosingGlove final : public Device {
 public:
  bool held = true;
  bool lost = false;
  double closed_rad = 0;
  hand::HandForce force;
  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration) noexcept override {
    client::HandSample hand;
    hand.kind = client::HandKind::glove;
    hand.joints.fill(closed_rad);
    return hand;
  }
  void write(const hand::HandForce& wanted) noexcept override { force = wanted; }
  [[nodiscard]] DeviceCondition condition() const noexcept override {
    if (lost) return DeviceCondition::lost;
    return held ? DeviceCondition::ready : DeviceCondition::not_ready;
  }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {.max_force_n = 0, .max_torque_nm = 0}; }
};

TEST(WallTest, HoldsTheFingersOfAGloveUntilItIsLetGo) {
  ClosingGlove glove;
  auto wall = WallTest::make(glove, 0);
  ASSERT_TRUE(wall);
  for (int i = 0; i < 1000; ++i)
    wall->tick(kTickPeriod);
  EXPECT_EQ(wall->report().finger_force_max_n, 0);
  glove.closed_rad = 0.9;
  for (int i = 0; i < 1000; ++i)
    wall->tick(kTickPeriod);
  EXPECT_EQ(glove.force.finger_force_n[2], 1);
  EXPECT_TRUE(glove.force.force_W.f.isZero(0));
  glove.held = false;
  wall->tick(kTickPeriod);
  EXPECT_EQ(glove.force.finger_force_n[2], 0);
}

TEST(WallTest, RemembersThatTheDeviceWasLostButNotThatItWasWaitedFor) {
  ClosingGlove glove;
  auto wall = WallTest::make(glove, 0);
  ASSERT_TRUE(wall);
  const auto tick_with = [&](bool lost) {
    glove.lost = lost;
    wall->tick(kTickPeriod);
    return wall->report().was_lost;
  };
  EXPECT_FALSE(tick_with(true)) << "it has given no state yet";
  EXPECT_FALSE(tick_with(false));
  EXPECT_TRUE(tick_with(true));
  EXPECT_TRUE(tick_with(false)) << "it is back";
}

}  // namespace
}  // namespace mechane::haptic
