// A crank that is held over a network: what its hinge does to the hand does not wait for the server.
#include "tests/support/held_crank.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mechane {
namespace {

using namespace std::chrono_literals;
using haptic::RenderMode;
using test::HeldCrank;
using test::Network;

TEST(HeldCrank, IsAsStiffAcrossItsCircleForAClientAsForTheServer) {
  HeldCrank server(RenderMode::server, {.delay_ms = 1}), local(RenderMode::local, {.delay_ms = 1});
  const double direct = server.stiffness_across();
  EXPECT_NEAR(direct, 600, 30);
  EXPECT_NEAR(local.stiffness_across(), direct, 0.05 * direct);
}

TEST(HeldCrank, StaysAsStiffOverASlowNetworkAndGivesTheHandNoEnergy) {
  for (const int delay_ms : {20, 50}) {
    HeldCrank crank(RenderMode::local, {delay_ms, 5, 0.05});
    EXPECT_NEAR(crank.stiffness_across(), 600, 60) << delay_ms << " ms";
    EXPECT_LE(crank.energy_max_j(), 0.001) << delay_ms << " ms";
  }
}

/// The joint is undone, and done again, while a hand pulls: the spring is there again at once, with the hand off its path.
TEST(HeldCrank, ThatIsTiedAgainWhileItIsPulledGivesTheHandNoEnergy) {
  for (const int delay_ms : {1, 20, 50}) {
    HeldCrank crank(RenderMode::local, {delay_ms, 5, 0.05});
    for (int i = 0; i < 3; ++i) {
      crank.go(Vec3(0.008, 0, 0), 500ms);
      crank.state().joints[0].enabled = false;
      crank.stay(20ms);
      crank.state().joints[0].enabled = true;
      crank.stay(500ms);
      crank.go(Vec3(-0.008, 0, 0), 500ms);
    }
    EXPECT_LE(crank.energy_max_j(), 0.001) << delay_ms << " ms";
  }
}

/// Carried up and down, so that the hand is given back what it had put in.
TEST(HeldCrank, OffItsAxleWeighsAsMuchOverASlowNetwork) {
  for (const int delay_ms : {1, 20, 50}) {
    HeldCrank crank(RenderMode::local, {delay_ms, 5, 0.05}, 1, test::make_loose_crank());
    EXPECT_NEAR(crank.weight_share(), 1, 0.02) << delay_ms << " ms";
    crank.go(Vec3(0, 0.1, 0), 2s);
    EXPECT_NEAR(crank.weight_share(), 1, 0.02) << delay_ms << " ms";
    const double lifted_m = crank.p_WH().y();
    crank.go(Vec3(0, -0.1, 0), 2s);
    EXPECT_LT(crank.p_WH().y(), lifted_m - 0.09);
    EXPECT_NEAR(crank.weight_share(), 1, 0.02) << delay_ms << " ms";
    EXPECT_LE(crank.energy_max_j(), test::kLooseCrank_n * 0.02) << delay_ms << " ms: the arm sags when it grasps";
  }
}

/// Two turns in eight seconds.
TEST(HeldCrank, IsTurnedOverASlowNetworkWithTheHandKeptOnItsCircle) {
  HeldCrank crank(RenderMode::local, {20, 5, 0.05});
  const Vec3& p_BG = crank.state().users[0].grasp.p_BG;
  // The stylus does not turn: its tip goes round a circle of its own, as large as that of the place that it holds.
  const double radius_m = std::hypot(p_BG.x(), p_BG.y());
  const Vec3 middle = HeldCrank::start() - Vec3(radius_m, 0, 0);
  double off_m = 0;
  for (int i = 0; i < 8000; ++i) {
    // The hand means to go round one that is a centimetre too small.
    const double angle = 2 * kPi * i / 4000, inwards_m = 0.01 * std::min(1.0, i / 200.0);
    crank.tick(middle + (radius_m - inwards_m) * Vec3(std::cos(angle), std::sin(angle), 0));
    if (i > 500) off_m = std::max(off_m, std::abs((crank.p_WH() - middle).norm() - radius_m));
  }
  EXPECT_GT(crank.turned_rad(), 0.9 * 4 * kPi);
  EXPECT_TRUE(crank.state().users[0].grasp.active);
  EXPECT_LT(off_m, 0.0065) << "half of the centimetre is the arm's spring";
}

}  // namespace
}  // namespace mechane
