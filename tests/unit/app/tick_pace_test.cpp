#include "server/app/tick_pace.hpp"

#include <gtest/gtest.h>

namespace mechane::app {
namespace {

using Passage = transport::WorldPort::Passage;

constexpr Passage kAll{true, true};
constexpr Passage kNoHands{false, true};
constexpr Passage kNobodyThere{false, false};
constexpr Passage kUnfelt{true, false};

class TickPaceTest : public testing::Test {
 protected:
  void ask(double pace) { ASSERT_TRUE(pace_.order({pace, 0})); }
  void step(std::uint32_t ticks) { ASSERT_TRUE(pace_.order({1, ticks})); }
  void expect(bool runs, const Passage& passage, bool at_rest = false) {
    const PacedTick tick = pace_.next(at_rest);
    EXPECT_EQ(tick.runs, runs);
    EXPECT_EQ(tick.passage, passage) << tick.passage.hands << tick.passage.forces;
  }
  /// Ticks that run in so many periods, at rest from the second one on.
  int count(int periods) {
    int ran = 0;
    for (int i = 0; i < periods; ++i)
      ran += pace_.next(i > 0).runs ? 1 : 0;
    return ran;
  }
  void pause() {
    ask(0);
    expect(true, kNoHands);
    expect(false, kNobodyThere, true);
  }

  TickPace pace_;
};

TEST_F(TickPaceTest, WithoutAnOrderNothingDiffers) {
  for (int i = 0; i < 100; ++i)
    expect(true, kAll);
  ask(1);
  expect(true, kAll);
}

TEST_F(TickPaceTest, APauseWaitsUntilForcesAreZero) {
  ask(0);
  for (int i = 0; i < 100; ++i)
    expect(true, kNoHands);
  expect(false, kNobodyThere, true);
  for (int i = 0; i < 100; ++i)
    expect(false, kNobodyThere, true);
}

TEST_F(TickPaceTest, ForcesThatWereZeroBeforeDoNotCount) {
  ask(0);
  expect(true, kNoHands, true);
  expect(false, kNobodyThere, true);
}

TEST_F(TickPaceTest, StepsRunOneByOneWhilePausedAndNeverElse) {
  step(5);
  expect(true, kAll);
  pause();
  expect(false, kNobodyThere, true);
  step(3);
  step(1);
  for (int i = 0; i < 4; ++i)
    expect(true, kNobodyThere, true);
  expect(false, kNobodyThere, true);
}

TEST_F(TickPaceTest, StepsAskedForOnTheWayToAPauseRunInIt) {
  ask(0);
  step(2);
  expect(true, kNoHands);
  expect(true, kNoHands);
  expect(true, kNobodyThere, true);
  expect(true, kNobodyThere, true);
  expect(false, kNobodyThere, true);
}

TEST_F(TickPaceTest, StepsThatAreLeftEndWithThePause) {
  pause();
  step(1000);
  expect(true, kNobodyThere, true);
  ask(0.5);
  EXPECT_EQ(count(100), 50);
  ask(0);
  EXPECT_EQ(count(100), 1) << "one tick, in which hands let go";
}

TEST_F(TickPaceTest, ASlowWorldHasHandsThatFeelNothing) {
  ask(0.25);
  expect(true, kNoHands);
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 3; ++i)
      expect(false, kUnfelt, true);
    expect(true, kUnfelt, true);
  }
  ask(0.1);
  EXPECT_NEAR(count(10'000), 1000, 1);
}

TEST_F(TickPaceTest, ForcesComeBackThroughZero) {
  ask(0.5);
  expect(true, kNoHands);
  expect(false, kUnfelt, true);
  ask(1);
  expect(true, kNobodyThere, true);
  expect(true, kNobodyThere, false);
  expect(true, kAll, true);
  pause();
  ask(1);
  expect(true, kNobodyThere, true);
  expect(true, kAll, true);
}

TEST_F(TickPaceTest, OrdersAreFollowedInTheirOrder) {
  ask(0);
  ask(0.5);
  ask(0);
  step(1);
  expect(true, kNoHands);
  expect(true, kNoHands);
  expect(true, kNobodyThere, true);
  expect(true, kNobodyThere, true);
  expect(false, kNobodyThere, true);
}

TEST_F(TickPaceTest, TooManyOrdersAreRefused) {
  int taken = 0;
  while (pace_.order({0.5, 0}) && taken < 1000)
    ++taken;
  EXPECT_EQ(taken, 64);
}

}  // namespace
}  // namespace mechane::app
