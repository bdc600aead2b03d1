#include "server/haptics/clicks.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "tests/support/floor_server.hpp"

namespace mechane::haptics {
namespace {

/// A wheel with a click at each whole turn, and one hand that holds it, one that does not.
class Wheel : public ::testing::Test {
 protected:
  static state::WorldDescription described() {
    state::WorldDescription world;
    world.bodies.resize(2);
    world.quantities.resize(1);
    state::EffectDescription effect;
    effect.kind = "sound.ratchet";
    effect.body = BodyId(0);
    effect.quantity = QuantityId(0);
    effect.force_n = 0.7;
    world.effects = {effect, effect};
    world.effects[1].kind = "touch.click";
    world.effects[1].felt = true;
    return world;
  }
  void SetUp() override {
    state_.users[0].present = state_.users[1].present = true;
    state_.users[0].grasp.active = state_.users[1].grasp.active = true;
    state_.users[0].grasp.body = BodyId(0);
    state_.users[1].grasp.body = BodyId(1);
  }
  /// How many clicks the hand has felt, after the quantity was `turns` for a while.
  std::uint32_t clicks_at(double turns) {
    state_.quantities[0] = turns;
    for (int i = 0; i < 50; ++i) {
      ++state_.tick;
      find_clicks(world_, state_);
    }
    return state_.users[0].clicks.count;
  }
  state::WorldDescription world_ = described();
  state::WorldState state_{world_};
};

TEST_F(Wheel, ClicksAtEachTurnForWhoHoldsIt) {
  EXPECT_EQ(clicks_at(3.5), 0u) << "nothing has turned yet";
  EXPECT_EQ(clicks_at(3.99), 0u);
  EXPECT_EQ(clicks_at(4), 1u);
  EXPECT_EQ(clicks_at(5), 2u);
  EXPECT_EQ(clicks_at(3), 3u) << "backwards, too";
  EXPECT_EQ(clicks_at(0), 4u) << "several at once are one";
  EXPECT_EQ(state_.users[0].clicks.strength_n, 0.7);
  EXPECT_EQ(state_.users[1].clicks.count, 0u) << "this hand holds something else";
}

TEST_F(Wheel, DoesNotClickWhereItTremblesOrHasNoNumber) {
  clicks_at(3.9);
  for (int i = 0; i < 10; ++i) {
    clicks_at(4.01);
    EXPECT_EQ(clicks_at(3.99), 1u);
  }
  EXPECT_EQ(clicks_at(std::numeric_limits<double>::quiet_NaN()), 1u);
  EXPECT_EQ(clicks_at(4.5), 1u);
}

TEST_F(Wheel, ClicksAtEachStepThatIsNoWholeNumber) {
  world_.effects[1].full = 0.1;
  clicks_at(0);
  for (std::uint32_t i = 1; i <= 10; ++i)
    EXPECT_EQ(clicks_at(0.1 * i), i) << "0.3 / 0.1 is a little less than 3";
}

TEST_F(Wheel, AStrongerClickIsNotMaskedByAWeakerOne) {
  const auto strength_n = [this] { return state_.users[0].clicks.strength_n; };
  add_click(state_.users[0], 1, 0.4);
  add_click(state_.users[0], 3, 0.3);
  EXPECT_EQ(strength_n(), 0.4);
  add_click(state_.users[0], 5, 0.9);
  EXPECT_EQ(strength_n(), 0.9);
  add_click(state_.users[0], 100, 0.001);
  EXPECT_EQ(state_.users[0].clicks.count, 2u) << "nobody feels so little";
}

TEST_F(Wheel, ClicksForAFingerThatLiesOnItAndNotForOneThatIsGone) {
  state_.users[1].grasp.active = false;
  state_.users[1].contacts[0].body = BodyId(0);
  state_.users[1].contact_count = 1;
  state_.users[0].present = false;
  clicks_at(0);
  EXPECT_EQ(clicks_at(1), 0u);
  EXPECT_EQ(state_.users[1].clicks.count, 1u);
}

TEST_F(Wheel, ThatSpinsFastClicksFiftyTimesASecondAtMost) {
  for (int i = 0; i < 1000; ++i) {
    ++state_.tick;
    state_.quantities[0] = i;
    find_clicks(world_, state_);
  }
  EXPECT_EQ(state_.users[0].clicks.count, 50u);
}

TEST(Knock, IsFeltAtTheFirstTouchAsHardAsTheHandCame) {
  state::HapticMaterial stone;
  stone.knock_ns_per_m = 5;
  test::FloorServer server(stone);
  hand::HandSample hand;
  hand.X_WH.p.y() = 0.010;
  hand.V_WH.v.y() = -0.1;
  EXPECT_EQ(server.answer(hand).clicks.count, 0u);
  hand.X_WH.p.y() = 0.007;
  const auto answer_for_a_while = [&] {
    for (int i = 0; i < 100; ++i)
      server.answer(hand);
    return server.answer(hand).clicks;
  };
  EXPECT_EQ(answer_for_a_while().count, 1u);
  EXPECT_NEAR(answer_for_a_while().strength_n, 0.5, 0.01);
  hand.X_WH.p.y() = 0.010;
  EXPECT_EQ(answer_for_a_while().count, 1u);
  hand.X_WH.p.y() = 0.007;
  hand.V_WH.v.y() = -2;
  EXPECT_EQ(answer_for_a_while().count, 2u);
  EXPECT_EQ(answer_for_a_while().strength_n, hand::kMaxClick_n);
}

}  // namespace
}  // namespace mechane::haptics
