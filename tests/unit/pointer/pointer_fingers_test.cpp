#include "client-sdk/pointer/pointer_fingers.hpp"

#include <limits>
#include <map>
#include <numbers>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/pointer/pointer_hand.hpp"

namespace mechane::pointer {
namespace {

using EventKind = PointerEvent::Kind;

constexpr picture::PixelSize kGlassPane{1280, 720};
constexpr double kTickOfFingers_s = 0.002;

PointerEvent finger_event(EventKind kind, FingerId finger, double x, double y) {
  PointerEvent event{kind, x, y};
  event.finger = finger;
  return event;
}

/// Fingers, the hand that they move, and a thing that it takes anywhere; what has come loose from them is told by GTest.
class Table {
 public:
  Table() {
    camera_.p_WC = Vec3(0, 1, 3);
    camera_.p_WT = Vec3(0, 1, 0);
    sight_ = picture::Sight{picture::eye_view(camera_, picture::Eye::middle, 16.0 / 9), kGlassPane};
    senses_.X_WB.p = Vec3(0, 1, 0);
    senses_.leeway.taken = true;
  }

  /// Nothing lies in the picture's left quarter.
  void take(const PointerEvent& event) {
    follow(fingers_.take(event, {busy(), hand_.view().phase == PointerView::Phase::holding, kGlassPane}));
  }
  void follow(const std::vector<HandRequest>& requests) {
    for (const HandRequest& request : requests) {
      ASSERT_TRUE(std::isfinite(request.amount) && std::isfinite(request.place.x) && std::isfinite(request.place.y));
      switch (request.kind) {
        case HandRequest::Kind::take:
          if (request.place.x < kGlassPane.width / 4.0) {
            fingers_.missed();
          } else {
            senses_.X_WB.p = picture::point_at(sight_, request.place, 3);
            senses_.holding = false;
            hand_.press(sight_, request.place, {7, senses_.X_WB.p});
          }
          break;
        case HandRequest::Kind::move:
          hand_.move(request.place);
          requested_ = request.place;
          break;
        case HandRequest::Kind::twist:
          hand_.turn(request.amount);
          break;
        case HandRequest::Kind::deepen:
          hand_.deepen(request.amount);
          break;
        case HandRequest::Kind::release:
          hand_.release();
          break;
      }
    }
  }
  void pass(double seconds) {
    for (int k = 0; k < static_cast<int>(seconds / kTickOfFingers_s); ++k) {
      const auto input = hand_.advance(kTickOfFingers_s, senses_);
      if (!input) {
        last_.reset();
        senses_.holding = false;
        continue;
      }
      ASSERT_TRUE(input->X_WH.p.allFinite() && input->V_WH.v.allFinite() && input->V_WH.w.allFinite());
      ASSERT_NEAR(input->X_WH.R.norm(), 1, 1e-9);
      if (last_) {
        ASSERT_LE((input->X_WH.p - last_->p).norm(), 2.001 * kTickOfFingers_s) << "it jumps";
        ASSERT_LE(rotation_vector(input->X_WH.R * last_->R.conjugate()).norm(), 3.001 * kTickOfFingers_s);
      }
      last_ = input->X_WH;
      if (input->grasp_intent < 0.3) senses_.holding = false;
      if (input->grasp_intent > 0.5 && !senses_.holding) {
        senses_.holding = true;
        X_HB_ = input->X_WH.inverse() * senses_.X_WB;
      }
      if (senses_.holding) senses_.X_WB = input->X_WH * X_HB_;
    }
  }
  [[nodiscard]] bool busy() const {
    const auto phase = hand_.view().phase;
    return phase == PointerView::Phase::reaching || phase == PointerView::Phase::holding;
  }
  [[nodiscard]] bool holds() const { return hand_.view().phase == PointerView::Phase::holding && senses_.holding; }
  /// As the viewer sees the hands of a clock go, radians, -pi to pi.
  [[nodiscard]] double turned() const {
    const Vec3 x_W = senses_.X_WB.R * Vec3::UnitX();
    return -std::atan2(x_W.y(), x_W.x());
  }
  [[nodiscard]] double depth() const { return picture::depth_of(sight_, hand_.view().p_WH); }
  [[nodiscard]] picture::PixelPlace requested() const { return requested_; }
  void wait(double seconds) { follow(fingers_.pass(seconds)); }

 private:
  picture::Camera camera_;
  picture::Sight sight_;
  PointerFingers fingers_;
  PointerHand hand_;
  PointerSenses senses_;
  Pose X_HB_;
  std::optional<Pose> last_;
  picture::PixelPlace requested_;
};

void take_in_the_middle(Table& table) {
  table.take(finger_event(EventKind::press, 1, 640, 360));
  table.pass(1.2);
  ASSERT_TRUE(table.holds());
}

/// What a person may do with glass: presses, motions, lifts and losses, in any order and with any numbers.
PointerEvent any_event() {
  const auto kind = *rc::gen::element(EventKind::press, EventKind::press, EventKind::release, EventKind::release,
                                      EventKind::move, EventKind::move, EventKind::move, EventKind::turn_press,
                                      EventKind::turn_release, EventKind::gone);
  const auto finger = *rc::gen::inRange<FingerId>(0, 4);
  const double x =
      *rc::gen::element(0.0, 1.0) == 0.0 ? *rc::gen::inRange(0, 1280) : *rc::gen::inRange(-100'000, 100'000);
  const double y = *rc::gen::inRange(-10, 730);
  if (*rc::gen::inRange(0, 20) == 0) return finger_event(kind, finger, std::numeric_limits<double>::quiet_NaN(), y);
  return finger_event(kind, finger, x, y);
}

RC_GTEST_PROP(PointerFingers, whatever_fingers_do_a_hand_without_one_lets_go, ()) {
  Table table;
  std::map<FingerId, bool> down;
  for (int k = *rc::gen::inRange(0, 60); k > 0; --k) {
    const PointerEvent event = any_event();
    table.take(event);
    if (event.kind == EventKind::press) down[event.finger] = true;
    if (event.kind == EventKind::release) down.erase(event.finger);
    if (event.kind == EventKind::gone) down.clear();
    if (down.empty()) RC_ASSERT(!table.busy());
    table.pass(*rc::gen::element(0.0, 0.004, 0.6));
    if (testing::Test::HasFatalFailure()) RC_FAIL("the hand, see above");
  }
  for (const auto& [finger, is_down] : std::map(down))
    table.take(finger_event(EventKind::release, finger, 0, 0));
  RC_ASSERT(!table.busy());
}

RC_GTEST_PROP(PointerFingers, a_motion_of_a_finger_moves_the_hand_by_no_more, ()) {
  Table table;
  take_in_the_middle(table);
  table.take(finger_event(EventKind::move, 1, 640, 360));
  table.take(finger_event(EventKind::press, 2, 800, 300));
  std::map<FingerId, picture::PixelPlace> at{{1, {640, 360}}, {2, {800, 300}}};
  picture::PixelPlace hand = table.requested();
  bool both = true;
  for (int k = 0; k < 40; ++k) {
    const FingerId finger = *rc::gen::element<FingerId>(1, 2);
    const picture::PixelPlace to{static_cast<double>(*rc::gen::inRange(0, 1280)),
                                 static_cast<double>(*rc::gen::inRange(0, 720))};
    if (at.contains(finger)) {
      table.take(finger_event(EventKind::move, finger, to.x, to.y));
      const double moved = std::hypot(to.x - at[finger].x, to.y - at[finger].y);
      RC_ASSERT(std::hypot(table.requested().x - hand.x, table.requested().y - hand.y) <= moved + 1e-9);
      at[finger] = to;
    }
    if (both && k == 20) {  // one is lifted, and the hand stays where it is
      both = false;
      const FingerId lifted = *rc::gen::element<FingerId>(1, 2);
      hand = table.requested();
      table.take(finger_event(EventKind::release, lifted, at[lifted].x, at[lifted].y));
      at.erase(lifted);
      RC_ASSERT(table.requested().x == hand.x && table.requested().y == hand.y);
      RC_ASSERT(table.holds());
    }
    hand = table.requested();
  }
}

RC_GTEST_PROP(PointerFingers, what_two_carry_turns_as_they_turn_and_comes_as_they_spread, ()) {
  Table table;
  take_in_the_middle(table);
  const double depth = table.depth();
  const double turn = *rc::gen::inRange(-300, 301) / 100.0;
  const double spread = *rc::gen::inRange(60, 200) / 100.0;
  table.take(finger_event(EventKind::press, 2, 840, 360));
  for (int k = 1; k <= 30; ++k) {
    const double angle = turn * k / 30, half = 100 * (1 + (spread - 1) * k / 30);
    table.take(finger_event(EventKind::move, 1, 740 - half * std::cos(angle), 360 - half * std::sin(angle)));
    table.take(finger_event(EventKind::move, 2, 740 + half * std::cos(angle), 360 + half * std::sin(angle)));
    table.pass(0.05);
  }
  table.pass(2);
  RC_ASSERT(std::abs(std::remainder(table.turned() - turn, 2 * std::numbers::pi)) < 0.15);
  RC_ASSERT(std::abs(table.depth() * spread / depth - 1) < 0.02);
}

TEST(PointerFingers, TheMousesRightButtonTurnsAndDoesNotMove) {
  Table table;
  table.take(finger_event(EventKind::press, kMouse, 640, 360));
  table.pass(1.2);
  table.take(finger_event(EventKind::move, kMouse, 650, 360));
  const picture::PixelPlace before = table.requested();
  table.take(finger_event(EventKind::turn_press, kMouse, 650, 360));
  table.take(finger_event(EventKind::move, kMouse, 1010, 360));
  table.pass(2);
  EXPECT_NEAR(table.turned(), std::numbers::pi / 2, 0.1);
  EXPECT_EQ(table.requested().x, before.x);
  table.take(finger_event(EventKind::turn_release, kMouse, 1010, 360));
  table.take(finger_event(EventKind::move, kMouse, 1020, 360));
  EXPECT_NEAR(table.requested().x, before.x + 10, 1e-9) << "it goes on from where it was";
}

TEST(PointerFingers, AFingerThatWentWithoutAWordLetsGo) {
  Table table;
  take_in_the_middle(table);
  table.wait(29);
  EXPECT_TRUE(table.holds());
  table.take(finger_event(EventKind::move, 1, 641, 360));
  table.wait(29);
  EXPECT_TRUE(table.holds()) << "it has moved since";
  table.wait(2);
  EXPECT_FALSE(table.busy());
}

TEST(PointerFingers, AMouseMayRestAsLongAsItLikes) {
  Table table;
  table.take(finger_event(EventKind::press, kMouse, 640, 360));
  table.pass(1.2);
  table.wait(1e6);
  EXPECT_TRUE(table.holds());
}

TEST(PointerFingers, ASecondFingerTakesWhereTheFirstHasNothingLeftToDo) {
  Table table;
  table.take(finger_event(EventKind::press, 1, 20, 360));  // nothing is there
  EXPECT_FALSE(table.busy());
  table.take(finger_event(EventKind::press, 2, 640, 360));
  EXPECT_TRUE(table.busy());
  table.take(finger_event(EventKind::release, 1, 20, 360));
  EXPECT_TRUE(table.busy()) << "it was not its hand";
  table.take(finger_event(EventKind::release, 2, 640, 360));
  EXPECT_FALSE(table.busy());
}

}  // namespace
}  // namespace mechane::pointer
