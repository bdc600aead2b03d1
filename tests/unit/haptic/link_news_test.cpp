#include "client-sdk/haptic/link_news.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;
using client::LinkState;
using ::testing::HasSubstr;

TEST(LinkNews, TellsEachChangeOnceAndWarnsWhereNoServerAnswers) {
  LinkNews news({.kiosk = "kiosk-7", .user = 1, .domain = 84});
  TimePoint now{1h};
  const auto look = [&](LinkState state, const std::string& refusal = "") {
    now += 200ms;
    return news.look(state, refusal, now);
  };
  EXPECT_THAT(look(LinkState::searching)->text, HasSubstr("domain 84"));
  std::optional<LinkNews::Line> warning;
  for (Duration waited{0}; waited < LinkNews::kPatience; waited += 200ms) {
    ASSERT_FALSE(warning) << "before its time";
    warning = look(LinkState::searching);
  }
  ASSERT_TRUE(warning);
  EXPECT_EQ(warning->level, log::Level::warning);
  EXPECT_THAT(warning->text, HasSubstr("--domain"));
  for (int i = 0; i < 100; ++i)
    ASSERT_FALSE(look(LinkState::searching));

  EXPECT_THAT(look(LinkState::joined)->text, HasSubstr("hand 1 of kiosk-7"));
  EXPECT_FALSE(look(LinkState::joined));
  EXPECT_EQ(look(LinkState::lost)->level, log::Level::warning);
  EXPECT_FALSE(look(LinkState::lost));
  EXPECT_EQ(look(LinkState::joined)->level, log::Level::info) << "it is back";
  EXPECT_EQ(look(LinkState::refused, "taken")->text, "taken");
  EXPECT_FALSE(look(LinkState::refused, "taken"));
  EXPECT_EQ(look(LinkState::refused, "taken by another")->text, "taken by another");
}

}  // namespace
}  // namespace mechane::haptic
