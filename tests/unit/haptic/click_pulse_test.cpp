#include "client-sdk/haptic/click_pulse.hpp"

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

/// The strongest force of the next tenth of a second.
double strongest_n(ClickPulse& pulse) {
  double most_n = 0;
  for (int i = 0; i < 400; ++i)
    most_n = std::max(most_n, pulse.render(kTickPeriod / 4).norm());
  return most_n;
}

TEST(ClickPulse, IsAShortShakeAsStrongAsTheServerSaysAndOver) {
  ClickPulse pulse;
  pulse.hear({.count = 7, .strength_n = 1});
  EXPECT_EQ(strongest_n(pulse), 0) << "it was before our time";
  pulse.hear({.count = 7, .strength_n = 1});
  EXPECT_EQ(strongest_n(pulse), 0) << "it is the same";
  pulse.hear({.count = 8, .strength_n = 1});
  const double felt_n = strongest_n(pulse);
  EXPECT_NEAR(felt_n, 1, 0.02);
  EXPECT_EQ(strongest_n(pulse), 0);
}

TEST(ClickPulse, IsNotFeltWhereTheCountBeginsAnewOrAfterASilence) {
  ClickPulse pulse;
  pulse.hear({.count = 7, .strength_n = 1});
  pulse.hear({.count = 0, .strength_n = 0});
  EXPECT_EQ(strongest_n(pulse), 0) << "another world";
  pulse.hear({.count = 1, .strength_n = 1});
  EXPECT_GT(strongest_n(pulse), 0);
  pulse.hear({.count = 2, .strength_n = 1});
  pulse.forget();
  pulse.hear({.count = 9, .strength_n = 1});
  EXPECT_EQ(strongest_n(pulse), 0);
}

TEST(ClickPulse, IsNeverStrongerThanAClickMayBe) {
  ClickPulse pulse;
  pulse.hear({.count = 1, .strength_n = 1});
  pulse.hear({.count = 2, .strength_n = 1e6});
  EXPECT_LE(strongest_n(pulse), 1.01 * hand::kMaxClick_n);
}

TEST(ClickPulse, AServerThatClicksAllTheTimeCannotPush) {
  ClickPulse pulse;
  Vec3 sum_n = Vec3::Zero();
  for (std::uint32_t i = 0; i < 1000; ++i) {
    pulse.hear({.count = i, .strength_n = hand::kMaxClick_n});
    sum_n += pulse.render(kTickPeriod);
  }
  EXPECT_LT(sum_n.norm() / 1000, 0.15);
}

}  // namespace
}  // namespace mechane::haptic
