#include "client-sdk/draw/quality_governor.hpp"

#include <array>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::draw {
namespace {

constexpr double kAllowed_ms = 16;

/// Pictures of a machine that takes so long for each quality.
class Machine {
 public:
  Machine(Quality start, double high_ms, double medium_ms, double cached_ms)
      : governor_(start, kAllowed_ms), ms_{high_ms, medium_ms, medium_ms, cached_ms} {}

  /// Returns how often the quality changed.
  int draw_for(double seconds) {
    int steps = 0;
    for (const TimePoint end = now_ + std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
         now_ < end;) {
      const Quality before = governor_.quality();
      steps += governor_.drawn(ms_[static_cast<std::size_t>(before)], now_) != before ? 1 : 0;
      now_ += std::chrono::milliseconds(16);
    }
    return steps;
  }
  [[nodiscard]] Quality quality() const { return governor_.quality(); }

 private:
  QualityGovernor governor_;
  std::array<double, 4> ms_;
  TimePoint now_{};
};

TEST(QualityGovernor, steps_down_as_far_as_it_must_and_no_farther) {
  Machine slow(Quality::high, 900, 300, 90);
  slow.draw_for(5);
  EXPECT_EQ(slow.quality(), Quality::cached);
  Machine middling(Quality::high, 40, 12, 5);
  middling.draw_for(5);
  EXPECT_EQ(middling.quality(), Quality::medium);
}

TEST(QualityGovernor, steps_up_where_there_is_time_to_spare) {
  Machine fast(Quality::cached, 4, 2, 1);
  fast.draw_for(60);
  EXPECT_EQ(fast.quality(), Quality::high);
}

TEST(QualityGovernor, a_step_up_that_fails_is_tried_less_and_less_often) {
  // Cached is so cheap that medium is tried, and too slow each time.
  Machine tempted(Quality::cached, 900, 60, 2);
  EXPECT_GT(tempted.draw_for(60), 0);
  EXPECT_LE(tempted.draw_for(3600), 2 * 7);
}

RC_GTEST_PROP(QualityGovernor, never_changes_while_times_stay_within_bounds, ()) {
  const auto start = *rc::gen::element(Quality::high, Quality::medium, Quality::cached);
  QualityGovernor governor(start, kAllowed_ms);
  const auto times_ms = *rc::gen::container<std::vector<int>>(400, rc::gen::inRange(5, 20));
  TimePoint now{};
  for (const int ms : times_ms)
    RC_ASSERT(governor.drawn(ms, now += std::chrono::milliseconds(100)) == start);
}

TEST(QualityGovernor, a_few_slow_pictures_change_nothing) {
  QualityGovernor governor(Quality::high, kAllowed_ms);
  for (int i = 0; i < 500; ++i)
    EXPECT_EQ(governor.drawn(i % 3 == 0 ? 500 : 10, TimePoint{}), Quality::high);
}

TEST(QualityGovernor, begins_with_what_the_machine_can_do) {
  EXPECT_EQ(quality_for({0.1, false}), Quality::high);
  EXPECT_EQ(quality_for({1.5, false}), Quality::medium);
  EXPECT_EQ(quality_for({25, true}), Quality::cached);
  EXPECT_EQ(quality_of("cached"), Quality::cached);
  EXPECT_EQ(quality_of("auto"), std::nullopt);
}

}  // namespace
}  // namespace mechane::draw
