#include "client-sdk/display/head_view.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::display {
namespace {

using namespace std::chrono_literals;

constexpr picture::ScreenSetup kWall{1.2, 2.0, 0.064};

client::ViewerHead seen_at_place(const Vec3& p_SV, TimePoint now) {
  return {{p_SV, Quat::Identity()}, true, now};
}

TEST(HeadView, FollowsAHeadAndReturnsSlowlyWhenTheTrackerIsSilent) {
  HeadView view(kWall);
  TimePoint now{1h};
  view.advance({}, now);
  EXPECT_EQ(view.place(), nullptr);
  const Vec3 p_SV(0.3, -0.2, 1.5);
  for (int i = 0; i < 60; ++i)
    view.advance(seen_at_place(p_SV, now), now += 16ms);
  ASSERT_NE(view.place(), nullptr);
  EXPECT_EQ(view.place()->p_SV, p_SV);
  const client::ViewerHead last = seen_at_place(p_SV, now);
  view.advance(last, now += 400ms);
  EXPECT_EQ(view.place()->p_SV, p_SV) << "a tracker may pause";
  view.advance(last, now += 200ms);
  EXPECT_FALSE(view.tracked());
  ASSERT_NE(view.place(), nullptr);
  EXPECT_GT((view.place()->p_SV - p_SV).norm(), 0.01);
  for (int i = 0; i < 200; ++i)
    view.advance(last, now += 16ms);
  EXPECT_EQ(view.place(), nullptr) << "as without a tracker";
}

TEST(HeadView, NobodyIsAsGoodAsSilence) {
  HeadView view(kWall);
  TimePoint now{1h};
  for (int i = 0; i < 60; ++i)
    view.advance(seen_at_place({0.3, 0, 2}, now), now += 16ms);
  for (int i = 0; i < 200; ++i)
    view.advance(client::ViewerHead{{}, false, now}, now += 16ms);
  EXPECT_EQ(view.place(), nullptr);
}

TEST(HeadView, WithoutAKnownScreenThereIsNoPlace) {
  HeadView view(picture::ScreenSetup{});
  TimePoint now{1h};
  view.advance(seen_at_place({0.3, 0, 2}, now), now += 16ms);
  EXPECT_EQ(view.place(), nullptr);
  EXPECT_TRUE(view.tracked());
}

RC_GTEST_PROP(HeadView, WhateverATrackerSaysThePictureStaysOneAndMovesSmoothly, ()) {
  HeadView view(kWall);
  TimePoint now{1h};
  Vec3 before(0, 0, kWall.viewer_distance_m);
  for (int i = 0; i < 40; ++i) {
    const auto any = [](double most) { return most * (*rc::gen::inRange(-1000, 1001)) / 1000.0; };
    std::optional<client::ViewerHead> head;
    if (*rc::gen::inRange(0, 5) > 0) {
      const Vec3 p(any(1e6), any(3), any(1e3));
      head = client::ViewerHead{{p, Quat(any(1), any(1), any(1), 1).normalized()}, *rc::gen::inRange(0, 4) > 0, now};
    }
    const Duration dt = std::chrono::milliseconds(*rc::gen::inRange(0, 100));
    view.advance(head, now += dt);
    const picture::HeadPlace place =
        view.place() != nullptr ? *view.place() : picture::HeadPlace{{0, 0, kWall.viewer_distance_m}, Vec3::UnitX()};
    RC_ASSERT(place.p_SV.allFinite() && place.p_SV.z() > 0);
    RC_ASSERT(std::abs(place.eyes_S.norm() - 1) < 1e-9);
    RC_ASSERT((place.p_SV - before).norm() <= 3.01 * to_seconds(dt) + 1e-9);
    before = place.p_SV;
  }
}

}  // namespace
}  // namespace mechane::display
