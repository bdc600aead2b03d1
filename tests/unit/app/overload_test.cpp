// When and how often a server says that it is overloaded, and by what.
#include "server/app/overload.hpp"

#include <gmock/gmock.h>

namespace mechane::app {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class Overload : public ::testing::Test {
 protected:
  /// Passes `count` windows of 10 000 ticks, each with these counts. Returns how often there was something to log.
  int windows(int count, const LoadCounts& each) {
    int spoke = 0;
    for (int i = 0; i < count; ++i) {
      now_ += OverloadWatch::kWindow;
      counts_.ticks += 10'000;
      counts_.overruns += each.overruns;
      counts_.held_up += each.held_up;
      counts_.input_gaps += each.input_gaps;
      counts_.longest_gap = each.longest_gap;
      spoke += watch_.look(counts_, now_) ? 1 : 0;
    }
    return spoke;
  }
  void SetUp() override { EXPECT_FALSE(watch_.look(counts_, now_)); }

  OverloadWatch watch_;
  LoadCounts counts_{.ticks = 5'000, .overruns = 400};  // from when the worlds were made
  TimePoint now_{1h};
};

TEST_F(Overload, SaysNothingOfAMachineThatKeepsUp) {
  EXPECT_EQ(windows(100, {.overruns = 3, .held_up = 3, .input_gaps = 5, .longest_gap = 15ms}), 0);
  EXPECT_EQ(watch_.words(), "");
}

TEST_F(Overload, SaysWhatIsTooMuchAndWhatToDo) {
  EXPECT_EQ(windows(1, {.overruns = 50, .held_up = 500, .input_gaps = 100}), 1);
  EXPECT_THAT(watch_.words(), HasSubstr("50 of 10000 ticks"));
  EXPECT_THAT(watch_.words(), HasSubstr("--worlds"));
  EXPECT_EQ(windows(1, {.held_up = 500, .input_gaps = 100}), 1);
  EXPECT_THAT(watch_.words(), HasSubstr("mechane doctor"));
  EXPECT_EQ(windows(1, {.input_gaps = 100, .longest_gap = 29ms}), 1);
  EXPECT_THAT(watch_.words(), HasSubstr("29 ms"));
}

TEST_F(Overload, IsToldOnceAMinuteWhileItLastsAndOnceWhenItIsOver) {
  EXPECT_EQ(windows(60, {.overruns = 100}), 10);
  EXPECT_EQ(windows(60, {}), 1);
  EXPECT_EQ(watch_.words(), "");
}

}  // namespace
}  // namespace mechane::app
