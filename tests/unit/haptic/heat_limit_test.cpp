#include "client-sdk/haptic/heat_limit.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

constexpr double kPeak = 3.3, kLong = 0.88;  // of a Touch

/// What is rendered in the last of these ticks when `wanted_n` is wanted in all.
double rendered_after(HeatLimit& heat, double wanted_n, Duration time) {
  double force_n = 0;
  for (Duration past{0}; past < time; past += kTickPeriod) {
    Vec3 force(0, wanted_n, 0);
    (void)heat.limit(force);
    heat.rendered(force_n = force.norm(), kTickPeriod);
  }
  return force_n;
}

TEST(HeatLimit, LetsTheLargestForceThroughForAMoment) {
  HeatLimit heat(kPeak, kLong);
  EXPECT_EQ(rendered_after(heat, kPeak, 1s), kPeak);
}

TEST(HeatLimit, EndsAtWhatIsBorneForLongWithoutAStep) {
  HeatLimit heat(kPeak, kLong);
  double before = rendered_after(heat, kPeak, 1ms);
  for (int i = 0; i < 60'000; ++i) {
    const double now = rendered_after(heat, kPeak, 1ms);
    ASSERT_GE(now, before * 0.998);
    before = now;
  }
  EXPECT_NEAR(before, kLong, 0.01 * kLong);
}

TEST(HeatLimit, NeverActsOnAForceThatIsBorneForLong) {
  HeatLimit heat(kPeak, kLong);
  for (int i = 0; i < 120'000; ++i) {
    Vec3 force(0, 0.99 * kLong, 0);
    ASSERT_FALSE(heat.limit(force));
    heat.rendered(force.norm(), kTickPeriod);
  }
}

TEST(HeatLimit, GivesTheLargestForceBackAfterARest) {
  HeatLimit heat(kPeak, kLong);
  (void)rendered_after(heat, kPeak, 60s);
  (void)rendered_after(heat, 0, 60s);
  EXPECT_EQ(rendered_after(heat, kPeak, 1ms), kPeak);
}

TEST(HeatLimit, LeavesADeviceWithoutForceAlone) {
  HeatLimit heat(0, 0);
  EXPECT_EQ(rendered_after(heat, 0, 1s), 0);
  Vec3 force(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_FALSE(HeatLimit(kPeak, kLong).limit(force)) << "the governor's business";
}

}  // namespace
}  // namespace mechane::haptic
