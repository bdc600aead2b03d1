#include "client-sdk/gateway/browsers/browser_hand.hpp"

#include <gtest/gtest.h>

#include "client-sdk/gateway/browsers/browser_text.hpp"

namespace mechane::gateway {
namespace {

using Kind = pointer::PointerEvent::Kind;

struct Moves {
  int made = 0, presses = 0, moves = 0, releases = 0;
  double turned = 0, deepened = 0;
};

/// Holds at once what it presses on.
class NotedHand final : public pointer::PointerTouch {
 public:
  explicit NotedHand(Moves& moves) : moves_(moves) { ++moves_.made; }
  void press(const picture::Sight&, picture::PixelPlace, const picture::Touched& touched) override {
    ++moves_.presses;
    view_.phase = pointer::PointerView::Phase::holding;
    view_.object = touched.object;
  }
  void move(picture::PixelPlace) override { ++moves_.moves; }
  void deepen(double amount) override { moves_.deepened += amount; }
  void turn(double angle) override { moves_.turned += angle; }
  void release() override {
    ++moves_.releases;
    view_.phase = pointer::PointerView::Phase::resting;
  }
  [[nodiscard]] pointer::PointerView view() override { return view_; }
  [[nodiscard]] pointer::PointerLinkState state() override { return pointer::PointerLinkState::joined; }

 private:
  Moves& moves_;
  pointer::PointerView view_;
};

/// A world with a crank (0), which can be taken while the agent is on, a wall (1), and a valve (2) and two levers as the
/// crank.
class BrowserHandTest : public testing::Test {
 protected:
  BrowserHandTest() : hand_([this] { return std::make_unique<NotedHand>(moves_); }) {
    objects_.resize(5);
    for (std::uint32_t i = 0; i < objects_.size(); ++i) {
      objects_[i].index = i;
      objects_[i].movable = i != 1;
      if (i == 1) continue;
      client::Affordance& taken = presentation_.affordances.emplace_back();
      taken.agent = "grasp";
      taken.object = i;
    }
    enabled_ = {"grasp"};
  }
  void send(const std::vector<PointerMessage::One>& events) {
    PointerMessage message{events, {}};
    message.sight.picture = {1280, 720};
    hand_.take(message, {nullptr, objects_, &presentation_, enabled_});
  }
  static PointerMessage::One event(Kind kind, std::optional<std::uint32_t> object = {}, pointer::FingerId finger = 0) {
    PointerMessage::One one;
    one.event.kind = kind;
    one.event.finger = finger;
    if (object) one.pick = picture::Touched{*object, Vec3::Zero()};
    return one;
  }

  Moves moves_;
  std::vector<client::SceneObject> objects_;
  client::WorldPresentation presentation_;
  std::vector<std::string> enabled_;
  BrowserHand hand_;
};

TEST_F(BrowserHandTest, TakesDragsAndLetsGo) {
  send({event(Kind::press, 0), event(Kind::move), event(Kind::wheel), event(Kind::release)});
  EXPECT_EQ(moves_.made, 1);
  EXPECT_EQ(moves_.presses, 1);
  EXPECT_EQ(moves_.moves, 1);
  EXPECT_EQ(moves_.releases, 1);
}

TEST_F(BrowserHandTest, WhatCannotBeTakenIsNotTaken) {
  send({event(Kind::press), event(Kind::release)});
  send({event(Kind::press, 1), event(Kind::release)});
  send({event(Kind::press, 9), event(Kind::release)});
  enabled_.clear();
  send({event(Kind::press, 0), event(Kind::move), event(Kind::release)});
  EXPECT_EQ(moves_.made, 0) << "and no hand of the kiosk is used up";
}

TEST_F(BrowserHandTest, LetsGoWhenTheBrowserIsGone) {
  send({event(Kind::press, 0)});
  hand_.release();
  EXPECT_EQ(moves_.releases, 1);
  send({event(Kind::press, 0)});
  EXPECT_EQ(moves_.presses, 2);
}

TEST_F(BrowserHandTest, TwoFingersOnTwoThingsAreTwoHandsAndOnOneThingOne) {
  send({event(Kind::press, 0, 1), event(Kind::press, 0, 2)});
  EXPECT_EQ(moves_.made, 1);
  send({event(Kind::press, 2, 3)});
  EXPECT_EQ(moves_.made, 2);
  ASSERT_EQ(hand_.told().size(), 2U);
  EXPECT_EQ(hand_.told()[0].view.object, 2U) << "what was touched last comes first";
  EXPECT_EQ(hand_.told()[1].view.object, 0U);
  const std::string text = pointer_text(hand_.told());
  EXPECT_NE(text.find(R"("others":[{)"), std::string::npos) << text;
  send({event(Kind::release, {}, 3)});
  EXPECT_EQ(moves_.releases, 1);
  ASSERT_EQ(hand_.told().size(), 1U);
  EXPECT_EQ(hand_.told()[0].view.object, 0U);
  EXPECT_EQ(pointer_text(hand_.told()).find("others"), std::string::npos);
  hand_.release();
  EXPECT_EQ(moves_.releases, 3) << "all of them";
}

TEST_F(BrowserHandTest, WhereNoHandIsLeftThatIsSaid) {
  send({event(Kind::press, 0, 1), event(Kind::press, 2, 2), event(Kind::press, 3, 3)});
  EXPECT_EQ(hand_.told()[0].link, pointer::PointerLinkState::joined);
  send({event(Kind::press, 4, 4)});
  EXPECT_EQ(moves_.made, 3) << "one hand is left for a device";
  EXPECT_EQ(hand_.told()[0].link, pointer::PointerLinkState::refused);
  EXPECT_EQ(hand_.note("en"), "All hands are busy at the moment");
  send({event(Kind::release, {}, 4)});
  EXPECT_NE(hand_.note("en"), "All hands are busy at the moment");
}

TEST_F(BrowserHandTest, TellsWhatTheHandDoes) {
  EXPECT_EQ(hand_.note("en"), "");
  send({event(Kind::press, 0)});
  EXPECT_FALSE(hand_.note("en").empty());
  EXPECT_NE(hand_.note("en"), hand_.note("el"));
}

}  // namespace
}  // namespace mechane::gateway
