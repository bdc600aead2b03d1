#include "client-sdk/scene/thing_names.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::scene {
namespace {

/// A board of 20 cm, 2 cm thick, turned a quarter about y.
picture::NamedThing board(std::uint32_t object, const Vec3f& p_W) {
  picture::NamedThing out;
  out.object = object;
  out.name = "Board " + std::to_string(object);
  out.X_WB = Eigen::Translation3f(p_W) * Eigen::AngleAxisf(static_cast<float>(kPi / 2), Vec3f::UnitY());
  out.box_B = Eigen::AlignedBox3f(Vec3f(-0.1F, -0.1F, -0.01F), Vec3f(0.1F, 0.1F, 0.01F));
  return out;
}

client::HandPose hand_at(const Vec3& p_WT) {
  client::HandPose hand;
  hand.X_WS[0].p = p_WT;
  return hand;
}

picture::Sight label_sight(const Vec3& p_WC, const Vec3& p_WT = Vec3::Zero()) {
  picture::Camera camera;
  camera.p_WC = p_WC;
  camera.p_WT = p_WT;
  return picture::seen_place(camera, picture::Stereo::mono, {1280, 720}, {})->sight;
}

/// Metres, this much to each side.
float some(float reach_m) {
  return reach_m * static_cast<float>(*rc::gen::inRange(-10'000, 10'001)) / 10'000;
}

TEST(ThingNames, a_free_finger_near_a_thing_means_the_nearest) {
  const std::vector<picture::NamedThing> things{board(3, {0, 0, 0}), board(4, {0, 0, 0.3F})};
  // Turned, a board reaches from z = -0.1 to 0.1, and is thin along x.
  EXPECT_EQ(named_near(things, std::vector{hand_at({0.05, 0, 0})})->object, 3U);
  EXPECT_EQ(named_near(things, std::vector{hand_at({0.03, 0, 0.16})})->object, 4U);
  EXPECT_EQ(named_near(things, std::vector{hand_at({0.03, 0, 0.14})})->object, 3U);
  EXPECT_FALSE(named_near(things, std::vector{hand_at({0.12, 0, 0})})) << "farther than a hand is broad";
  EXPECT_EQ(named_near(things, std::vector{hand_at({1, 1, 1}), hand_at({0.02, 0, 0.3})})->object, 4U) << "of any hand";
  EXPECT_FALSE(named_near({}, std::vector{hand_at({0, 0, 0})}));
  EXPECT_FALSE(named_near(things, std::vector{hand_at({std::nan(""), 0, 0})}));
}

TEST(ThingNames, of_things_in_each_other_the_inner_one_is_meant) {
  picture::NamedThing barrel = board(2, {0, 0, 0});
  barrel.box_B = Eigen::AlignedBox3f(Vec3f::Constant(-1), Vec3f::Constant(1));
  const std::vector hands{hand_at({0, 0, 0})};
  EXPECT_EQ(named_near(std::vector{barrel, board(3, {0, 0, 0})}, hands)->object, 3U);
  EXPECT_EQ(named_near(std::vector{board(3, {0, 0, 0}), barrel}, hands)->object, 3U);
  EXPECT_EQ(named_near(std::vector{barrel, board(3, {0, 0.5F, 0})}, hands)->object, 2U);
}

TEST(ThingNames, a_hand_that_holds_or_whose_device_is_silent_asks_for_none) {
  const std::vector<picture::NamedThing> things{board(3, {0, 0, 0})};
  std::vector hands{hand_at({0.02, 0, 0})};
  ASSERT_TRUE(named_near(things, hands));
  hands[0].holding = true;
  EXPECT_FALSE(named_near(things, hands));
  hands[0].holding = false;
  hands[0].stale = true;
  EXPECT_FALSE(named_near(things, hands));
}

TEST(ThingNames, a_gloves_index_is_what_points) {
  const std::vector<picture::NamedThing> things{board(3, {0, 0, 0})};
  client::HandPose glove;
  glove.kind = client::HandKind::glove;
  for (Pose& X_WS : glove.X_WS)
    X_WS.p = Vec3(2, 2, 2);
  EXPECT_FALSE(named_near(things, std::vector{glove}));
  glove.X_WS[6].p = Vec3(0.03, 0, 0);  // the index finger's end
  EXPECT_EQ(named_near(things, std::vector{glove})->object, 3U);
}

RC_GTEST_PROP(ThingNames, a_name_is_over_its_thing, ()) {
  const picture::NamedThing thing = board(3, Vec3f(some(1), some(0.5F), some(1)));
  const picture::Sight sight = label_sight({0, 0.2, 3});
  const Vec3 p_WT = thing.X_WB.translation().cast<double>();
  const auto label = label_of(std::vector{thing}, {3, p_WT}, sight);
  RC_ASSERT(label.has_value());
  RC_ASSERT(label->text == "Board 3");
  RC_ASSERT(label->framed);
  const auto middle = picture::pixel_of(sight, p_WT);
  RC_ASSERT(std::abs((label->left + label->right) / 2.0 - middle->x) < 20);
  RC_ASSERT(static_cast<double>(label->top) < middle->y);
  RC_ASSERT(static_cast<double>(label->bottom) > middle->y);
  for (const float y : {-0.1F, 0.1F}) {
    const auto edge = picture::pixel_of(sight, (thing.X_WB * Vec3f(0, y, 0)).cast<double>());
    RC_ASSERT(static_cast<double>(label->top) <= edge->y + 0.01);
    RC_ASSERT(static_cast<double>(label->bottom) >= edge->y - 0.01);
  }
}

TEST(ThingNames, of_a_large_thing_the_name_is_where_one_points) {
  picture::NamedThing ship = board(3, {0, 0, 0});
  ship.box_B = Eigen::AlignedBox3f(Vec3f(-8, -2, -8), Vec3f(8, 6, 8));  // the eye is in its midst
  const picture::Sight sight = label_sight({0, 0, 3});
  for (const Vec3& p_WT : {Vec3(0, 0, 0), Vec3(0.8, 0.4, 0), Vec3(-1, -0.5, 0.5)}) {
    const auto label = label_of(std::vector{ship}, {3, p_WT}, sight);
    ASSERT_TRUE(label);
    const auto at = picture::pixel_of(sight, p_WT);
    EXPECT_FALSE(label->framed);
    EXPECT_NEAR(label->left, at->x, 120) << p_WT.transpose();
    EXPECT_NEAR(label->right, at->x, 120);
    EXPECT_NEAR(label->top, at->y, 120);
    EXPECT_NEAR(label->bottom, at->y, 120);
  }
}

TEST(ThingNames, what_has_no_name_or_is_behind_the_eye_has_none) {
  const std::vector<picture::NamedThing> things{board(3, {0, 0, 0})};
  EXPECT_FALSE(label_of(things, {4, Vec3::Zero()}, label_sight({0, 0, 3})));
  EXPECT_FALSE(label_of(things, {3, Vec3::Zero()}, label_sight({0, 0, 3}, {0, 0, 6}))) << "it lies behind";
}

}  // namespace
}  // namespace mechane::scene
