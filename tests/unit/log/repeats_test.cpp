#include "server/log/repeats.hpp"

#include <gtest/gtest.h>

namespace mechane::log {
namespace {

using namespace std::chrono_literals;

/// What a log would show: "text" or "text +repeats".
class RepeatsTest : public testing::Test {
 protected:
  std::vector<std::string> say(std::string_view text, std::chrono::seconds at) {
    const Repeats::Time now = Repeats::Time{} + at;
    std::vector<std::string> out;
    for (const auto& counted : repeats_.take_over(now))
      out.push_back(counted.text + " +" + std::to_string(counted.repeats));
    if (repeats_.pass(text, 1, now)) out.emplace_back(text);
    return out;
  }
  using Lines = std::vector<std::string>;
  Repeats repeats_;
};

TEST_F(RepeatsTest, AFaultThatStaysIsShownOnceInAWindowWithItsCount) {
  EXPECT_EQ(say("a", 0s), Lines{"a"});
  EXPECT_EQ(say("a", 1s), Lines{});
  EXPECT_EQ(say("b", 2s), Lines{"b"});
  EXPECT_EQ(say("a", 59s), Lines{});
  EXPECT_EQ(say("a", 60s), (Lines{"a +2", "a"}));
}

TEST_F(RepeatsTest, AFaultThatIsGoneIsToldWithWhateverComesNext) {
  say("a", 0s);
  say("a", 1s);
  EXPECT_EQ(say("b", 600s), (Lines{"a +1", "b"}));
  EXPECT_EQ(say("b", 601s), Lines{});
  const auto rest = repeats_.take_all();
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].text, "b");
  EXPECT_EQ(rest[0].level, 1);
  EXPECT_TRUE(repeats_.take_all().empty());
}

TEST_F(RepeatsTest, ItRemembersSoManyTextsAndLosesNoCount) {
  say("a", 0s);
  say("a", 1s);
  std::size_t told = 0;
  for (int i = 0; i < 1000; ++i) {
    for (const std::string& line : say("text " + std::to_string(i), 2s))
      told += line == "a +1" ? 1 : 0;
  }
  EXPECT_EQ(told, 1U);
  EXPECT_EQ(say("a", 3s), Lines{"a"}) << "forgotten, so it is shown again";
}

}  // namespace
}  // namespace mechane::log
