#include "client-sdk/haptic/tracked_hand.hpp"

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.hpp"

namespace mechane::haptic {
namespace {

HandIntent hand_at(const Vec3& p_WH) {
  HandIntent intent;
  intent.kind = client::HandKind::glove;
  intent.X_WH.p = p_WH;
  return intent;
}

TEST(TrackedHand, IsThereFromItsThirdPictureOnAndFeelsNothing) {
  TrackedHand hand;
  EXPECT_FALSE(hand.renders());
  EXPECT_EQ(hand.limits().max_force_n, 0);
  hand.intend(hand_at(Vec3(0.1, 0.9, 0.2)));
  int ms = 0;
  while (hand.condition() != DeviceCondition::ready && ms < 1000) {
    (void)hand.read(kTickPeriod);
    ++ms;
  }
  EXPECT_NEAR(ms, 35, 2);
  EXPECT_LT((hand.read(kTickPeriod).X_WH.p - Vec3(0.1, 0.9, 0.2)).norm(), 0.002);
}

TEST(TrackedHand, IsSeenLateSixtyTimesASecondAndNotMoreAfterAPause) {
  TrackedHand hand;
  hand.intend(hand_at(Vec3::Zero()));
  for (int ms = 0; ms < 100; ++ms)
    (void)hand.read(kTickPeriod);
  (void)hand.read(std::chrono::seconds(1));
  hand.intend(hand_at(Vec3(1, 0, 0)));
  int pictures = 0, seen_after_ms = 0;
  Vec3 last = hand.read(kTickPeriod).X_WH.p;
  for (int ms = 0; ms < 1000; ++ms) {
    const Vec3 now = hand.read(kTickPeriod).X_WH.p;
    if (now != last) ++pictures;
    if (seen_after_ms == 0 && now.x() > 0.5) seen_after_ms = ms;
    last = now;
  }
  EXPECT_NEAR(pictures, 60, 1);
  EXPECT_GE(seen_after_ms, 32);
  EXPECT_LE(seen_after_ms, 51);
}

TEST(TrackedHand, TellsHowFastItGoesAndAllocatesNothing) {
  TrackedHand hand;
  client::HandSample sample;
  const test::AllocationGuard guard;
  for (int ms = 0; ms < 500; ++ms) {
    hand.intend(hand_at(Vec3(0.001 * ms, 0, 0)));
    sample = hand.read(kTickPeriod);
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_NEAR(sample.V_WH.v.x(), 1, 0.1) << "one metre a second";
}

}  // namespace
}  // namespace mechane::haptic
