#include "server/hand/freshness.hpp"

#include <random>

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

constexpr auto kNewer = SampleOrder::newer, kOlder = SampleOrder::older, kTooHigh = SampleOrder::too_high;

TEST(SampleAge, OnlyAHigherSequenceIsNew) {
  SampleAge age;
  const TimePoint t0{1s};
  EXPECT_EQ(age.age(t0), Duration::max());
  EXPECT_EQ(age.offer(7, 5, t0), kNewer);
  EXPECT_EQ(age.offer(7, 5, t0 + 3ms), kOlder) << "a repeated sample keeps nobody's force alive";
  EXPECT_EQ(age.offer(7, 4, t0 + 4ms), kOlder) << "nor does one that was overtaken";
  EXPECT_EQ(age.age(t0 + 4ms), 4ms);
  EXPECT_EQ(age.offer(7, 6, t0 + 5ms), kNewer);
  EXPECT_EQ(age.age(t0 + 5ms), 0ms);
}

TEST(SampleAge, ASequenceThatIsTooHighIsNotTaken) {
  SampleAge age;
  const TimePoint t0{1s};
  EXPECT_EQ(age.offer(7, 1, t0), kNewer);
  EXPECT_EQ(age.offer(7, ~std::uint64_t{0}, t0 + 1ms), kTooHigh);
  EXPECT_EQ(age.age(t0 + 1ms), 1ms);
  EXPECT_EQ(age.offer(7, 2, t0 + 2ms), kNewer);
  EXPECT_EQ(age.offer(7, 10'000, t0 + 10s), kNewer) << "the cable was out for 10 s";
}

TEST(SampleAge, ANewSessionStartsAfreshAndTheOldOneStaysOver) {
  SampleAge age;
  const TimePoint t0{1s};
  EXPECT_EQ(age.offer(7, 1000, t0), kNewer);
  EXPECT_EQ(age.offer(8, 1, t0 + 1ms), kNewer);
  EXPECT_EQ(age.offer(7, 1001, t0 + 2ms), kOlder) << "a straggler of the session before";
  EXPECT_EQ(age.session(), 8u);
  EXPECT_EQ(age.age(t0 + 2ms), 1ms);
  age.reset();
  EXPECT_EQ(age.age(t0 + 3ms), Duration::max());
  EXPECT_EQ(age.offer(7, 1, t0 + 3ms), kNewer);
}

/// A sender at 1 kHz of whose samples some are lost or come twice, and another one's false samples among them.
struct Stream {
  explicit Stream(std::uint32_t seed) : random(seed), sequence(1 + draw(1'000'000)) {}

  std::mt19937 random;
  SampleAge age;
  TimePoint now{1h};
  std::uint64_t sequence;
  Duration longest_silence{0};

  std::uint64_t draw(std::uint64_t below) { return random() % below; }
  void honest() {
    now += 1ms;
    ++sequence;
    if (draw(20) == 0) return;  // lost
    longest_silence = std::max(longest_silence, age.age(now));
    (void)age.offer(1, sequence, now);
    if (draw(20) == 0) (void)age.offer(1, sequence - draw(5), now);
  }
};

RC_GTEST_PROP(SampleAge, FalseSequencesNeverSilenceAHandThatIsKnown, (std::uint32_t seed)) {
  Stream stream(seed);
  (void)stream.age.offer(1, stream.sequence, stream.now);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t far = stream.sequence + 1'000'000 + (std::uint64_t{stream.random()} << stream.draw(33));
    if (stream.draw(2) == 0) RC_ASSERT(stream.age.offer(1, far, stream.now) == kTooHigh);
    stream.honest();
  }
  RC_ASSERT(stream.longest_silence < 20ms);
}

RC_GTEST_PROP(SampleAge, AFalseFirstSequenceIsForgottenThoughMoreFollow, (std::uint32_t seed)) {
  Stream stream(seed);
  std::uint64_t false_one = ~std::uint64_t{0} >> stream.draw(20);
  for (int i = 0; i < 2000; ++i) {
    if (i % 7 == 0) (void)stream.age.offer(1, false_one -= stream.draw(1000), stream.now);
    stream.honest();
  }
  RC_ASSERT(stream.age.sequence() <= stream.sequence);
  RC_ASSERT(stream.age.age(stream.now) < 20ms);
}

RC_GTEST_PROP(SampleAge, AfterAPauseOfAnyLengthTheNextSampleCounts, (std::uint32_t pause_ms)) {
  SampleAge age;
  const TimePoint t0{1s};
  const Duration pause = std::chrono::milliseconds(pause_ms);
  RC_ASSERT(age.offer(1, 500, t0) == kNewer);
  RC_ASSERT(age.offer(1, 500 + pause_ms + 1, t0 + pause) == kNewer);  // sent all the time, lost on the way
}

TEST(SampleAge, AClockThatStandsGivesNoNegativeAge) {
  SampleAge age;
  EXPECT_EQ(age.offer(1, 1, TimePoint{2s}), kNewer);
  EXPECT_EQ(age.age(TimePoint{1s}), 0ms);
}

}  // namespace
}  // namespace mechane::hand
