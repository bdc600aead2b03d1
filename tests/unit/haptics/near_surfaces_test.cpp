#include "server/haptics/near_surfaces.hpp"

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
