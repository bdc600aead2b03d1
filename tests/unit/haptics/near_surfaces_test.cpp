#include "server/haptics/near_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/floor_server.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptics {
namespace {

constexpr double kTip_m = 0.008;
constexpr double kNear_m = 0.02;

hand::HandSample tip_at(const Vec3& p_WH) {
  hand::HandSample sample;
  sample.X_WH.p = p_WH;
  return sample;
}

RC_GTEST_PROP(NearSurfaces, AreAnnouncedWithTheirGap, ()) {
  test::FloorServer server(0, 600);
  const double gap_m = *test::between(0.0005, kNear_m - 0.002);
  const Vec3 p_WH(*test::between(-0.05, 0.05), kTip_m + gap_m, *test::between(-0.05, 0.05));
  const hand::HapticOutput& output = server.answer(tip_at(p_WH));
  RC_ASSERT(output.contact_count == 1u);
  const hand::LocalContact& contact = output.contacts[0];
  RC_ASSERT(std::abs(contact.depth_m + gap_m) < 0.0005);
  RC_ASSERT(contact.n_W.y() > 0.99);
  RC_ASSERT(!output.touches());
  RC_ASSERT(contact.stiffness_n_per_m > 0);
}

TEST(NearSurfaces, WhatIsFarIsNotAnnounced) {
  test::FloorServer server(0, 600);
  EXPECT_EQ(server.answer(tip_at(Vec3(0, kTip_m + kNear_m + 0.005, 0))).contact_count, 0u);
}

TEST(NearSurfaces, ATouchIsNotAnnouncedASecondTime) {
  test::FloorServer server(0, 600);
  const hand::HapticOutput& output = server.answer(tip_at(Vec3(0, kTip_m - 0.002, 0)));
  EXPECT_EQ(output.contact_count, 1u);
  EXPECT_TRUE(output.touches());
}

/// What is announced and what is felt then push as hard, at the same depth.
TEST(NearSurfaces, PushAsHardAsTheTouchThatFollows) {
  test::FloorServer server(0, 600);
  const hand::LocalContact near = server.answer(tip_at(Vec3(0, kTip_m + 0.001, 0))).contacts[0];
  for (const double depth_m : {0.001, 0.002, 0.004}) {
    const hand::LocalContact touch = server.answer(tip_at(Vec3(0, kTip_m - depth_m, 0))).contacts[0];
    EXPECT_NEAR(near.stiffness_n_per_m * depth_m / (touch.stiffness_n_per_m * touch.depth_m), 1, 0.15) << depth_m;
  }
}

/// Two walls of one body with a slot between them, and the tip in it: the nearer wall is announced, as far as it is.
TEST(NearSurfaces, OfTwoWallsTheNearerIsAnnouncedAndNoneBetweenThem) {
  constexpr double kHalfSlot_m = 0.012;
  const Vec3 half_m(0.02, 0.05, 0.05);
  const std::array walls{geometry::NamedMesh{"left", test::box(half_m, Vec3(-kHalfSlot_m - half_m.x(), 0, 0))},
                         geometry::NamedMesh{"right", test::box(half_m, Vec3(kHalfSlot_m + half_m.x(), 0, 0))}};
  test::FloorServer server(std::make_shared<collision::Object>(collision_build::build_object(walls, {}).value()));
  for (const double x_m : {-0.002, -0.001, 0.0, 0.001, 0.002}) {
    const auto contacts = server.answer(tip_at(Vec3(x_m, 0, 0))).contact_span();
    ASSERT_EQ(contacts.size(), 1u) << x_m;
    EXPECT_NEAR(contacts[0].depth_m, -(kHalfSlot_m - std::abs(x_m) - kTip_m), 0.0007) << x_m;
    EXPECT_GT(std::abs(contacts[0].n_W.x()), 0.97) << x_m;
  }
}

TEST(NearSurfaces, InACornerTheNearerWallIsAnnounced) {
  const Vec3 half_m(0.05, 0.05, 0.05);
  const std::array walls{geometry::NamedMesh{"floor", test::box(half_m, Vec3(0, -half_m.y(), 0))},
                         geometry::NamedMesh{"wall", test::box(half_m, Vec3(-half_m.x(), half_m.y(), 0))}};
  test::FloorServer server(std::make_shared<collision::Object>(collision_build::build_object(walls, {}).value()));
  const auto contacts = server.answer(tip_at(Vec3(0.013, kTip_m + 0.002, 0))).contact_span();
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].depth_m, -0.002, 0.001);
  EXPECT_GT(contacts[0].n_W.y(), 0.9);
}

TEST(NearSurfaces, AFingertipOfAGloveIsToldOfThem) {
  test::FloorServer server(0, 600);
  hand::HandSample glove = tip_at(Vec3(-0.1, 0.02, 0));
  glove.kind = hand::HandKind::glove;
  const auto contacts = server.answer(glove).contact_span();
  EXPECT_GE(std::count_if(contacts.begin(), contacts.end(), [](const auto& c) { return c.depth_m <= 0; }), 4)
      << "four fingers lie over the block";
}

}  // namespace
}  // namespace mechane::haptics
