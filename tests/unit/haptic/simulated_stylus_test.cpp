#include "client-sdk/haptic/simulated_stylus.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

void run(SimulatedStylus& stylus, Duration time) {
  for (Duration past{0}; past < time; past += kTickPeriod)
    (void)stylus.read(kTickPeriod);
}

hand::HandForce force_y(double newtons) {
  hand::HandForce force;
  force.force_W.f.y() = newtons;
  return force;
}

TEST(SimulatedStylus, SlowsDownByItsDampingAndItsDryFriction) {
  SimulatedStylus damped({.mass_kg = 0.1, .viscous_ns_per_m = 0.5, .coulomb_n = 0});
  damped.push(Vec3(0.1, 0, 0));
  run(damped, 10s);
  EXPECT_NEAR(damped.p_WH().x(), 0.1 * 0.1 / 0.5, 1e-5) << "m v / b";
  SimulatedStylus rubbed({.mass_kg = 0.1, .viscous_ns_per_m = 0, .coulomb_n = 0.05});
  rubbed.push(Vec3(0, 0.1, 0));
  run(rubbed, 1s);
  EXPECT_NEAR(rubbed.p_WH().y(), 0.1 * 0.1 * 0.1 / (2 * 0.05), 1e-5) << "m v^2 / 2 f";
  rubbed.write(force_y(0.049));
  const Vec3 before = rubbed.p_WH();
  run(rubbed, 1s);
  EXPECT_EQ(rubbed.p_WH(), before) << "a force below the friction does not move it";
}

TEST(SimulatedStylus, TellsPlacesInTheStepsOfItsEncoders) {
  SimulatedStylus stylus({.resolution_m = 5.5e-5});
  stylus.push(Vec3(0.01, 0.02, -0.03));
  for (int ms = 0; ms < 50; ++ms) {
    const client::HandSample sample = stylus.read(kTickPeriod);
    const Vec3 counts = sample.X_WH.p / 5.5e-5;
    EXPECT_NEAR((counts - counts.array().round().matrix()).norm(), 0, 1e-9);
    EXPECT_LE((sample.X_WH.p - stylus.p_WH()).cwiseAbs().maxCoeff(), 0.5 * 5.5e-5 + 1e-12);
  }
}

TEST(SimulatedStylus, AForceActsAfterItsDelay) {
  SimulatedStylus stylus({.coulomb_n = 0, .delay = 3});
  stylus.write(force_y(1));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(stylus.force_W(), Vec3::Zero()) << i;
    stylus.write(force_y(0));
  }
  EXPECT_EQ(stylus.force_W().y(), 1);
}

TEST(SimulatedStylus, AHandHoldsIt) {
  SimulatedStylus stylus({.coulomb_n = 0, .hand = ArmConfig{}});
  stylus.intend(Vec3(0.02, 0, 0));
  run(stylus, 2s);
  EXPECT_NEAR(stylus.p_WH().x(), 0.02, 1e-6);
  stylus.write(force_y(3));
  run(stylus, 2s);
  EXPECT_NEAR(stylus.p_WH().y(), 3 / ArmConfig{}.stiffness_n_per_m, 1e-6);
}

/// How much a stylus that rests on a wall with a weight of 0.5 N still moves, from `from` to `to` after a hit.
double moves(SimulatedStylus& stylus, double stiffness, Duration time) {
  double low = 1, high = -1;
  for (Duration past{0}; past < time; past += kTickPeriod) {
    stylus.write(force_y(std::max(0.0, -stiffness * stylus.read(kTickPeriod).X_WH.p.y())));
    low = std::min(low, stylus.p_WH().y());
    high = std::max(high, stylus.p_WH().y());
  }
  return high - low;
}

// A spring of a loop of period T is stable on a bare stylus up to 2 b / T, and over a delay t up to b / (T / 2 + t).
TEST(SimulatedStylus, AWallIsStableUpToTheStiffnessThatTheorySays) {
  for (const std::uint32_t delay : {0u, 2u, 10u}) {
    const double limit = 0.5 / (0.5e-3 + delay * 1e-3);
    for (const double share : {0.8, 1.25}) {
      SimulatedStylus stylus(
          {.mass_kg = 0.1, .coulomb_n = 0, .resolution_m = 1e-8, .delay = delay, .load_W = Vec3(0, -0.5, 0)});
      stylus.push(Vec3(0, -0.1, 0));
      moves(stylus, share * limit, 2s);
      const double early_m = moves(stylus, share * limit, 1s);
      moves(stylus, share * limit, 20s);
      const double late_m = moves(stylus, share * limit, 1s);
      EXPECT_EQ(late_m < 0.9 * early_m, share < 1)
          << share << " of the limit at a delay of " << delay << ": " << early_m << " m, then " << late_m;
    }
  }
}

}  // namespace
}  // namespace mechane::haptic
