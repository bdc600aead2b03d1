#include "server/transport/validate.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::transport {
namespace {

proto::HapticInput honest() {
  proto::HapticInput s{};
  s.protocol = proto::kProtocol;
  s.session = 7;
  s.X_WH.q[0] = 1;
  s.hand_scale = 1;
  std::ranges::fill(s.finger_scale, 1.0F);
  return s;
}

TEST(Validate, TakesAnHonestSample) {
  hand::SentSample out;
  EXPECT_EQ(validate(honest(), out), Reject::none);
}

RC_GTEST_PROP(Validate, WhatItTakesIsFitForTheLoop, ()) {
  // A valid sample except for one word of random bits: where it is accepted, it must be fit for the loop.
  proto::HapticInput s = honest();
  const auto words = sizeof(s) / 4;
  const auto where = *rc::gen::inRange<std::size_t>(0, words);
  const auto bits = *rc::gen::arbitrary<std::uint32_t>();
  std::memcpy(reinterpret_cast<char*>(&s) + 4 * where, &bits, 4);
  hand::SentSample out;
  if (validate(s, out) != Reject::none) return;
  RC_ASSERT(out.X_WH.p.norm() < hand::kFarthestHand_m);
  RC_ASSERT(std::abs(out.X_WH.R.norm() - 1) < 1e-9);
  RC_ASSERT(out.V_WH.v.norm() < kMaxSpeedMPerS);
  RC_ASSERT(out.hand_scale >= hand::kMinHandScale && out.hand_scale <= hand::kMaxHandScale);
  for (const double scale : out.finger_scale)
    RC_ASSERT(scale >= hand::kMinFingerScale - 1e-6 && scale <= hand::kMaxFingerScale + 1e-6);
  RC_ASSERT(hand::is_hand_side(static_cast<std::uint8_t>(out.side)));
  RC_ASSERT(out.grasp_intent >= 0 && out.grasp_intent <= 1);
  RC_ASSERT(out.session != 0);
}

TEST(Validate, RefusesADeadbandThatIsNoShare) {
  hand::SentSample out;
  const auto refused = [&](float share) {
    proto::HapticInput s = honest();
    s.deadband = share;
    return validate(s, out);
  };
  EXPECT_EQ(refused(0.5F), Reject::none);
  EXPECT_EQ(refused(0.51F), Reject::bad_value);
  EXPECT_EQ(refused(-0.1F), Reject::bad_value);
  EXPECT_EQ(refused(std::numeric_limits<float>::quiet_NaN()), Reject::not_finite);
}

TEST(Validate, RefusesSizesThatNoHandHasAndTakesTheOthers) {
  hand::SentSample out;
  const auto of_finger = [&](float scale) {
    proto::HapticInput s = honest();
    s.finger_scale[4] = scale;
    return validate(s, out);
  };
  for (const double scale : {hand::kMinFingerScale, 1.1, hand::kMaxFingerScale}) {
    EXPECT_EQ(of_finger(static_cast<float>(scale)), Reject::none);
    EXPECT_NEAR(out.finger_scale[4], scale, 1e-6);
  }
  for (const float scale : {0.0F, 0.69F, 1.41F, -1.0F})
    EXPECT_EQ(of_finger(scale), Reject::bad_size);
  EXPECT_EQ(of_finger(std::numeric_limits<float>::infinity()), Reject::not_finite);
  proto::HapticInput s = honest();
  s.side = mechane_hand_left;
  EXPECT_EQ(validate(s, out), Reject::none);
  EXPECT_EQ(out.side, hand::HandSide::left);
  s.side = mechane_hand_left + 1;
  EXPECT_EQ(validate(s, out), Reject::bad_value);
}

TEST(Validate, ReportsEachReasonOnce) {
  RejectCounters counters;
  RejectReport report;
  EXPECT_TRUE(report.since_last(counters).empty());
  counters.add(Reject::not_finite);
  counters.add(Reject::not_finite);
  EXPECT_EQ(report.since_last(counters), "rejected 2 samples: 2 not finite");
  EXPECT_TRUE(report.since_last(counters).empty());
}

}  // namespace
}  // namespace mechane::transport
