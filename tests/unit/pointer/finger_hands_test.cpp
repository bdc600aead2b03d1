#include "client-sdk/pointer/finger_hands.hpp"

#include <map>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::pointer {
namespace {

using EventKind = PointerEvent::Kind;
constexpr picture::PixelSize kPane{1280, 720};

PointerEvent touch_event(EventKind kind, FingerId finger, double x = 640, double y = 360) {
  PointerEvent event{kind, x, y};
  event.finger = finger;
  return event;
}

/// Hands that hold at once what they are told to take.
class Bench {
 public:
  Bench() {
    for (HandState& state : states_)
      state.picture = kPane;
  }
  void take(const PointerEvent& event, std::optional<std::uint32_t> on = {}) {
    follow(fingers_.take(event, on, states_), on);
  }
  void press(FingerId finger, std::optional<std::uint32_t> on, double x = 640) {
    take(touch_event(EventKind::press, finger, x), on);
  }
  void lift(FingerId finger) { take(touch_event(EventKind::release, finger)); }
  void pass(double seconds) { follow(fingers_.pass(seconds), {}); }
  /// The server took it from the hand.
  void lose(std::size_t hand) { states_.at(hand) = {false, false, kPane}; }

  /// By hand; none: it has nothing.
  [[nodiscard]] std::optional<std::uint32_t> held(std::size_t hand) const { return states_.at(hand).object; }
  [[nodiscard]] std::size_t busy() const {
    return static_cast<std::size_t>(std::ranges::count(states_, true, &HandState::busy));
  }
  [[nodiscard]] const FingerHands& fingers() const { return fingers_; }
  [[nodiscard]] const std::multiset<HandRequest::Kind>& asked(std::size_t hand) { return asked_[hand]; }

 private:
  void follow(const std::vector<HandOrder>& orders, std::optional<std::uint32_t> on) {
    for (const auto& [hand, request] : orders) {
      ASSERT_LT(hand, kMostFingerHands);
      asked_[hand].insert(request.kind);
      if (request.kind == HandRequest::Kind::release) states_[hand] = {false, false, kPane};
      if (request.kind != HandRequest::Kind::take) continue;
      if (on)
        states_[hand] = {true, true, kPane, on};
      else
        fingers_.missed(hand);
    }
  }

  FingerHands fingers_;
  std::array<HandState, kMostFingerHands> states_;
  std::map<std::size_t, std::multiset<HandRequest::Kind>> asked_;
};

RC_GTEST_PROP(FingerHands, one_thing_has_one_hand_and_a_hand_without_fingers_has_nothing, ()) {
  Bench bench;
  std::map<FingerId, std::optional<std::uint32_t>> down;  // with the thing that it came down on
  for (int k = *rc::gen::inRange(0, 60); k > 0; --k) {
    const FingerId finger = *rc::gen::inRange<FingerId>(0, 7);
    const auto thing = *rc::gen::inRange<std::uint32_t>(0, 5);
    switch (*rc::gen::inRange(0, 8)) {
      case 0:
      case 1:
      case 2:
        down[finger] = thing == 0 ? std::nullopt : std::optional(thing);
        bench.press(finger, down[finger], *rc::gen::inRange(0, 1280));
        break;
      case 3:
      case 4:
        down.erase(finger);
        bench.lift(finger);
        break;
      case 5:
        bench.take(touch_event(EventKind::move, finger, *rc::gen::inRange(0, 1280)));
        break;
      case 6:
        bench.lose(*rc::gen::inRange<std::size_t>(0, kMostFingerHands));
        break;
      default:
        down.clear();
        bench.take(touch_event(EventKind::gone, kMouse));
    }
    std::set<std::uint32_t> held;
    for (std::size_t hand = 0; hand < kMostFingerHands; ++hand)
      if (const auto object = bench.held(hand)) RC_ASSERT(held.insert(*object).second);
    RC_ASSERT(bench.busy() <= down.size());
    for (FingerId other = 0; other < 7; ++other)
      RC_ASSERT(down.contains(other) || !bench.fingers().hand_of(other));
  }
  for (const auto& [finger, on] : std::map(down))
    bench.lift(finger);
  RC_ASSERT(bench.busy() == 0U);
  RC_ASSERT(!bench.fingers().none_left());
}

RC_GTEST_PROP(FingerHands, different_things_are_different_hands_up_to_three, ()) {
  Bench bench;
  const auto things = *rc::gen::unique<std::vector<std::uint32_t>>(5, rc::gen::inRange<std::uint32_t>(0, 100));
  std::set<std::size_t> hands;
  for (std::size_t k = 0; k < things.size(); ++k) {
    const auto finger = static_cast<FingerId>(k + 1);
    bench.press(finger, things[k]);
    const auto hand = bench.fingers().hand_of(finger);
    RC_ASSERT(hand.has_value() == (k < kMostFingerHands));
    if (hand) RC_ASSERT(hands.insert(*hand).second);
    RC_ASSERT(bench.fingers().none_left() == !hand);
  }
  bench.lift(4);
  RC_ASSERT(bench.fingers().none_left());
  bench.lift(5);
  RC_ASSERT(!bench.fingers().none_left());
  bench.lift(2);
  bench.press(6, things[4]);
  RC_ASSERT(bench.held(*bench.fingers().hand_of(6)) == things[4]);
}

TEST(FingerHands, TwoFingersOnOneThingAreOneHandThatBringsItNearer) {
  Bench bench;
  bench.press(1, 7, 600);
  bench.press(2, 7, 700);
  EXPECT_EQ(bench.busy(), 1U);
  EXPECT_EQ(bench.fingers().hand_of(1), bench.fingers().hand_of(2));
  bench.take(touch_event(EventKind::move, 2, 800));
  EXPECT_EQ(bench.asked(0).count(HandRequest::Kind::deepen), 1U);
  EXPECT_EQ(bench.asked(0).count(HandRequest::Kind::take), 1U);
}

TEST(FingerHands, AFingerBesideThingsHelpsTheNearestHand) {
  Bench bench;
  bench.press(1, 7, 100);
  bench.press(2, 8, 1100);
  bench.press(3, {}, 1000);
  EXPECT_EQ(bench.fingers().hand_of(3), bench.fingers().hand_of(2));
  bench.press(4, {}, 1050);
  EXPECT_EQ(bench.fingers().hand_of(4), bench.fingers().hand_of(1)) << "two fingers are enough for a hand";
  EXPECT_EQ(bench.busy(), 2U);
}

TEST(FingerHands, EachHandLetsGoForItself) {
  Bench bench;
  bench.press(1, 7);
  bench.press(2, 8);
  bench.lift(1);
  EXPECT_FALSE(bench.held(0));
  EXPECT_EQ(bench.held(1), 8U);
  bench.pass(31);
  EXPECT_EQ(bench.busy(), 0U) << "a finger that went without a word";
}

TEST(FingerHands, TheMouseIsAHandBesideFingers) {
  Bench bench;
  bench.press(kMouse, 7);
  bench.press(1, 8);
  bench.press(2, {});
  EXPECT_EQ(bench.busy(), 2U);
  EXPECT_EQ(bench.fingers().hand_of(2), bench.fingers().hand_of(1)) << "a mouse has no second finger";
}

}  // namespace
}  // namespace mechane::pointer
