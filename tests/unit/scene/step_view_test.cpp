#include "client-sdk/scene/step_view.hpp"

#include <chrono>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "client-sdk/picture/sight.hpp"

namespace mechane::scene {
namespace {

using Box = Eigen::AlignedBox3d;

constexpr TimePoint kStart{std::chrono::seconds(100)};
constexpr double kAspect = 16.0 / 9;

double between(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

/// From where a machine of three metres is seen.
picture::Camera usual_view() {
  picture::Camera camera;
  camera.p_WC = Vec3(0.4, 1.7, 4);
  camera.p_WT = Vec3(0, 1, 0);
  camera.field_of_view_rad = 0.8;
  return camera;
}

Box box_of_hand(const Vec3& p_WH) {
  return {p_WH - Vec3::Constant(0.09), p_WH + Vec3::Constant(0.09)};
}

/// Where the box is in the picture: shares of its height, from the lower edge, and of its width.
Eigen::AlignedBox2d drawn(const Box& box_W, const picture::Camera& camera) {
  const picture::EyeView view = picture::eye_view(camera, picture::Eye::middle, kAspect);
  Eigen::AlignedBox2d out;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p_W = box_W.corner(static_cast<Box::CornerType>(corner));
    const Eigen::Vector4f clip = view.P * view.V_CW * p_W.cast<float>().homogeneous();
    out.extend((0.5 * (1 + clip.head<2>().array() / clip.w())).matrix().cast<double>());
  }
  return out;
}

double turned_rad(const picture::Camera& from, const picture::Camera& to) {
  return Quat::FromTwoVectors(from.p_WT - from.p_WC, to.p_WT - to.p_WC).angularDistance(Quat::Identity());
}

TEST(StepView, WhereNobodyWorksTheUsualViewIsShownToTheBit) {
  StepView view;
  view.follow({}, usual_view(), kAspect, kStart);
  EXPECT_EQ(view.shown(usual_view(), kAspect).p_WT, usual_view().p_WT);
  EXPECT_FALSE(view.is_narrow());
}

TEST(StepView, AHandBehindTheCameraChangesNothing) {
  StepView view;
  view.follow(box_of_hand(Vec3(0, 1, 6)), usual_view(), kAspect, kStart);
  EXPECT_EQ(view.shown(usual_view(), kAspect).p_WT, usual_view().p_WT);
}

RC_GTEST_PROP(StepView, a_hand_anywhere_on_the_machine_is_large_and_above_the_captions, ()) {
  const Box hand_W = box_of_hand(Vec3(between(-1.2, 1.2), between(0.6, 1.6), between(-0.5, 0.5)));
  StepView view;
  view.follow(hand_W, usual_view(), kAspect, kStart);
  const Eigen::AlignedBox2d seen = drawn(hand_W, view.shown(usual_view(), kAspect));
  RC_ASSERT(seen.sizes().y() > 0.2);
  RC_ASSERT(seen.min().y() > 0.33);
  RC_ASSERT(seen.max().y() < 0.97);
  RC_ASSERT(seen.min().x() > 0.03 && seen.max().x() < 0.97);
}

RC_GTEST_PROP(StepView, what_a_hand_and_a_far_goal_need_is_shown, ()) {
  Box work_W = box_of_hand(Vec3(between(-1, 1), between(0.8, 1.4), 0));
  work_W.extend(Vec3(between(-1, 1), between(0.8, 1.4), 0));
  StepView view;
  view.follow(work_W, usual_view(), kAspect, kStart);
  const Eigen::AlignedBox2d seen = drawn(work_W, view.shown(usual_view(), kAspect));
  RC_ASSERT((seen.min().array() > 0).all() && (seen.max().array() < 1).all());
}

TEST(StepView, ItFollowsGentlyAndRestsWhileAHandGoesRound) {
  StepView view;
  const auto crank = [](double angle) {
    return box_of_hand(Vec3(0.5 + 0.2 * std::cos(angle), 1 + 0.2 * std::sin(angle), 0));
  };
  view.follow({}, usual_view(), kAspect, kStart);
  picture::Camera before = view.shown(usual_view(), kAspect);
  for (int picture = 1; picture <= 1200; ++picture) {
    view.follow(crank(0.05 * picture), usual_view(), kAspect, kStart + picture * std::chrono::milliseconds(16));
    const picture::Camera now = view.shown(usual_view(), kAspect);
    EXPECT_LT(turned_rad(before, now), 0.01) << "no cut";
    if (picture > 600) {
      EXPECT_EQ(now.p_WT, before.p_WT) << "the whole circle is in the view";
    }
    before = now;
  }
  EXPECT_TRUE(view.is_narrow());
}

TEST(StepView, ItStandsStillWhileItIsHeldAndReturnsAfterwards) {
  StepView view;
  view.follow(box_of_hand(Vec3(0.5, 1, 0)), usual_view(), kAspect, kStart);
  const Vec3 held = view.shown(usual_view(), kAspect).p_WT;
  view.hold(kStart + std::chrono::seconds(60));
  EXPECT_EQ(view.shown(usual_view(), kAspect).p_WT, held);
  view.follow({}, usual_view(), kAspect, kStart + std::chrono::seconds(60) + std::chrono::milliseconds(16));
  EXPECT_LT((view.shown(usual_view(), kAspect).p_WT - held).norm(), 0.05) << "no cut";
  view.follow({}, usual_view(), kAspect, kStart + std::chrono::seconds(90));
  EXPECT_EQ(view.shown(usual_view(), kAspect).p_WT, usual_view().p_WT);
}

TEST(StepView, AnotherPlaceIsShownAtOnce) {
  StepView view;
  view.follow(box_of_hand(Vec3(0.5, 1, 0)), usual_view(), kAspect, kStart);
  picture::Camera elsewhere = usual_view();
  elsewhere.p_WC.x() += 50;
  elsewhere.p_WT.x() += 50;
  view.follow({}, elsewhere, kAspect, kStart + std::chrono::milliseconds(16));
  EXPECT_EQ(view.shown(elsewhere, kAspect).p_WT, elsewhere.p_WT);
}

}  // namespace
}  // namespace mechane::scene
