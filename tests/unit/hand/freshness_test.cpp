#include "server/hand/freshness.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::hand {
namespace {

using namespace std::chrono_literals;

TEST(Freshness, HoldsTo10msAndIsExactlyZeroBy50ms) {
  EXPECT_EQ(freshness(-1s), 1.0);
  EXPECT_EQ(freshness(0ms), 1.0);
  EXPECT_EQ(freshness(10ms), 1.0);
  EXPECT_LT(freshness(11ms), 1.0);
  EXPECT_NEAR(freshness(30ms), 0.5, 1e-12);
  EXPECT_GT(freshness(49ms), 0.0);
  EXPECT_EQ(freshness(50ms), 0.0);
  EXPECT_EQ(freshness(Duration::max()), 0.0);
}

RC_GTEST_PROP(Freshness, NeverRisesWithAge, (std::uint32_t a_us, std::uint32_t b_us)) {
  const Duration a = std::chrono::microseconds(a_us % 60'000);
  const Duration b = a + std::chrono::microseconds(b_us % 60'000);
  RC_ASSERT(freshness(a) >= freshness(b));
  RC_ASSERT(freshness(a) <= 1.0);
  RC_ASSERT(freshness(b) >= 0.0);
}

TEST(SampleAge, OnlyAHigherSequenceIsNew) {
  SampleAge age;
  const TimePoint t0{1s};
  EXPECT_EQ(age.age(t0), Duration::max());
  EXPECT_TRUE(age.offer(7, 5, t0));
  EXPECT_FALSE(age.offer(7, 5, t0 + 3ms)) << "a repeated sample keeps nobody's force alive";
  EXPECT_FALSE(age.offer(7, 4, t0 + 4ms)) << "nor does one that was overtaken";
  EXPECT_EQ(age.age(t0 + 4ms), 4ms);
  EXPECT_TRUE(age.offer(7, 6, t0 + 5ms));
  EXPECT_EQ(age.age(t0 + 5ms), 0ms);
  EXPECT_TRUE(age.offer(7, ~std::uint64_t{0}, t0 + 6ms));
  EXPECT_FALSE(age.offer(7, 0, t0 + 7ms)) << "a sequence that wraps is not new";
}

TEST(SampleAge, ANewSessionStartsAfreshAndTheOldOneStaysOver) {
  SampleAge age;
  const TimePoint t0{1s};
  EXPECT_TRUE(age.offer(7, 1000, t0));
  EXPECT_TRUE(age.offer(8, 1, t0 + 1ms));
  EXPECT_FALSE(age.offer(7, 1001, t0 + 2ms)) << "a straggler of the session before";
  EXPECT_EQ(age.session(), 8u);
  EXPECT_EQ(age.age(t0 + 2ms), 1ms);
  age.reset();
  EXPECT_EQ(age.age(t0 + 3ms), Duration::max());
  EXPECT_TRUE(age.offer(7, 1, t0 + 3ms));
}

TEST(SampleAge, AClockThatStandsGivesNoNegativeAge) {
  SampleAge age;
  EXPECT_TRUE(age.offer(1, 1, TimePoint{2s}));
  EXPECT_EQ(age.age(TimePoint{1s}), 0ms);
}

}  // namespace
}  // namespace mechane::hand
