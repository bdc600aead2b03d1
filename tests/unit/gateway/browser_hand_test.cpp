#include "client-sdk/gateway/browser_hand.hpp"

#include <gtest/gtest.h>

namespace mechane::gateway {
namespace {

using Kind = pointer::PointerEvent::Kind;

struct Moves {
  int made = 0, presses = 0, moves = 0, releases = 0;
  double turned = 0, deepened = 0;
  pointer::PointerView view;
};

class NotedHand final : public pointer::PointerTouch {
 public:
  explicit NotedHand(Moves& moves) : moves_(moves) { ++moves_.made; }
  void press(const picture::Sight&, picture::PixelPlace, const picture::Touched&) override {
    ++moves_.presses;
    moves_.view.phase = pointer::PointerView::Phase::holding;
  }
  void move(picture::PixelPlace) override { ++moves_.moves; }
  void deepen(double amount) override { moves_.deepened += amount; }
  void turn(double angle) override { moves_.turned += angle; }
  void release() override {
    ++moves_.releases;
    moves_.view.phase = pointer::PointerView::Phase::resting;
  }
  [[nodiscard]] pointer::PointerView view() override { return moves_.view; }
  [[nodiscard]] pointer::PointerLinkState state() override { return pointer::PointerLinkState::joined; }

 private:
  Moves& moves_;
};

/// A world with a crank (0), which can be taken while the agent is on, and a wall (1).
class BrowserHandTest : public testing::Test {
 protected:
  BrowserHandTest() : hand_([this] { return std::make_unique<NotedHand>(moves_); }) {
    objects_.resize(2);
    objects_[0].movable = true;
    objects_[1].index = 1;
    presentation_.affordances.resize(1);
    presentation_.affordances[0].agent = "grasp";
    enabled_ = {"grasp"};
  }
  void send(const std::vector<PointerMessage::One>& events) {
    PointerMessage message{events, {}};
    message.sight.picture = {1280, 720};
    hand_.take(message, {nullptr, objects_, &presentation_, enabled_});
  }
  static PointerMessage::One event(Kind kind, std::optional<std::uint32_t> object = {}) {
    PointerMessage::One one;
    one.event.kind = kind;
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

TEST_F(BrowserHandTest, TellsWhatTheHandDoes) {
  EXPECT_EQ(hand_.note("en"), "");
  send({event(Kind::press, 0)});
  EXPECT_FALSE(hand_.note("en").empty());
  EXPECT_NE(hand_.note("en"), hand_.note("el"));
}

}  // namespace
}  // namespace mechane::gateway
