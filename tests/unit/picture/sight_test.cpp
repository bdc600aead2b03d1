#include "client-sdk/picture/sight.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::picture {
namespace {

constexpr PixelSize kSeen{1280, 720};

/// A camera 2 m in front of the origin.
RenderScene scene_with(const SeenThing& thing) {
  RenderScene scene;
  scene.camera.p_WC = Vec3(0, 0, 2);
  scene.camera.p_WT = Vec3::Zero();
  scene.seen = {thing};
  return scene;
}

TEST(SeenThings, APointHasABoxOfItsSizeAboutIt) {
  const auto boxes = boxes_of(scene_with({{Vec3f::Zero()}, 0.1F}), Stereo::mono, kSeen);
  ASSERT_EQ(boxes.size(), 1U);
  const double half = 0.1 / (2 * std::tan(kPi / 8)) * 360;
  EXPECT_NEAR(boxes[0].left, 640 - half, 0.1);
  EXPECT_NEAR(boxes[0].right, 640 + half, 0.1);
  EXPECT_NEAR(boxes[0].top, 360 - half, 0.1);
  EXPECT_NEAR(boxes[0].bottom, 360 + half, 0.1);
}

TEST(SeenThings, OfALargeThingOnlyWhatIsNearCounts) {
  const SeenThing beam{{Vec3f(-0.8F, 0, 0), Vec3f(0.8F, 0.02F, 0)}, 0, Vec3f(0.5F, 0, 0)};
  const auto boxes = boxes_of(scene_with(beam), Stereo::mono, kSeen);
  ASSERT_EQ(boxes.size(), 1U);
  EXPECT_NEAR(boxes[0].right - boxes[0].left, 2 * 0.14 * 720, 0.5);
  EXPECT_GT(boxes[0].left, 640);
}

TEST(SeenThings, WhatIsBehindTheEyeOrBesideThePictureHasNone) {
  for (const Vec3f& p_W : {Vec3f(0, 0, 3), Vec3f(9, 0, 0), Vec3f(std::nanf(""), 0, 0)})
    EXPECT_TRUE(boxes_of(scene_with({{p_W}, 0.1F}), Stereo::mono, kSeen).empty()) << p_W.transpose();
  EXPECT_TRUE(boxes_of(scene_with({{Vec3f::Zero()}, 0.1F}), Stereo::mono, {0, 0}).empty());
}

RC_GTEST_PROP(SeenThings, both_eyes_places_are_within_a_box, ()) {
  const auto place = [] { return static_cast<float>(*rc::gen::inRange(-700, 700)) / 1000; };
  const RenderScene scene = scene_with({{Vec3f(place(), place(), place())}, 0.03F});
  const auto whole = boxes_of(scene, Stereo::side_by_side, kSeen);
  for (const Stereo eye : {Stereo::left_eye, Stereo::right_eye}) {
    for (const PictureBox& one : boxes_of(scene, eye, kSeen)) {
      RC_ASSERT(whole.size() == 1);
      RC_ASSERT(whole[0].left <= one.left && whole[0].right >= one.right);
      RC_ASSERT(whole[0].top <= one.top && whole[0].bottom >= one.bottom);
    }
  }
}

}  // namespace
}  // namespace mechane::picture
