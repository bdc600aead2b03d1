#include "client-sdk/pointer/pointer_affordances.hpp"

#include <map>

#include <gtest/gtest.h>

namespace mechane::pointer {
namespace {

using client::Affordance;

/// A frame that stands askew, and a wheel on it.
struct Mill {
  std::map<std::uint32_t, Pose> X_WB{{0, {{1, 0, 0}, Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()))}},
                                     {1, {{1, 1, 0}, Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()))}}};
  std::vector<Affordance> affordances{{Affordance::Kind::taken, "HOLD", 1, {}, {}, {}},
                                      {Affordance::Kind::turns, "", 1, 0, {{0, 1, 0}, Quat::Identity()}, {}}};

  [[nodiscard]] Leeway of(std::uint32_t object, std::vector<std::string> enabled) const {
    return leeway_of(affordances, enabled, object, [this](std::uint32_t other) {
      const auto found = X_WB.find(other);
      return found == X_WB.end() ? std::nullopt : std::optional(found->second);
    });
  }
};

TEST(PointerAffordances, AWheelTurnsAboutItsAxleInTheWorld) {
  const Leeway leeway = Mill().of(1, {"HOLD"});
  EXPECT_TRUE(leeway.taken);
  ASSERT_TRUE(leeway.axle);
  EXPECT_NEAR((leeway.axle->p_W - Vec3(1, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((leeway.axle->a_W - Vec3(1, 0, 0)).norm(), 0, 1e-12);
}

TEST(PointerAffordances, WhatIsNotOnItsAxleIsLoose) {
  Mill mill;
  mill.X_WB[1].p.x() += 0.1;
  EXPECT_FALSE(mill.of(1, {"HOLD"}).axle);
  mill = {};
  mill.X_WB[1].R = Quat(Eigen::AngleAxisd(0.4, Vec3::UnitZ())) * mill.X_WB[1].R;
  EXPECT_FALSE(mill.of(1, {"HOLD"}).axle);
}

TEST(PointerAffordances, OnItsTrackAThingMayBeAnywhere) {
  Mill mill;
  mill.affordances[1].kind = Affordance::Kind::slides;
  mill.X_WB[1].p.z() -= 0.7;  // along the frame's x
  ASSERT_TRUE(mill.of(1, {"HOLD"}).track);
  EXPECT_NEAR((mill.of(1, {"HOLD"}).track->a_W - Vec3(0, 0, -1)).norm(), 0, 1e-12);
  mill.X_WB[1].p.x() += 0.1;
  EXPECT_FALSE(mill.of(1, {"HOLD"}).track);
}

TEST(PointerAffordances, AgentsOfOtherStepsDoNotCount) {
  EXPECT_FALSE(Mill().of(1, {}).taken);
  EXPECT_FALSE(Mill().of(0, {"HOLD"}).taken);
  EXPECT_FALSE(Mill().of(9, {"HOLD"}).taken);
  Mill silent;
  silent.affordances.clear();
  EXPECT_TRUE(silent.of(1, {}).taken) << "an older server";
}

TEST(PointerAffordances, PlacesAreInTheFrameOfWhatTheyAreIn) {
  Mill mill;
  mill.affordances = {
      {Affordance::Kind::placed, "SEAT", 1, 0, {{0, 2, 0.5}, Quat::Identity()}, {}},
      {Affordance::Kind::brought, "LIGHT", 1, {}, {{0, 3, 0}, Quat::Identity()}, {{0, 0, -0.5}, Quat::Identity()}}};
  const Leeway leeway = mill.of(1, {"SEAT", "LIGHT"});
  ASSERT_EQ(leeway.goals.size(), 2U);
  EXPECT_TRUE(leeway.goals[0].turns_too);
  EXPECT_NEAR((leeway.goals[0].X_WB.p - Vec3(1.5, 2, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(leeway.goals[1].turns_too);
  EXPECT_NEAR((leeway.goals[1].X_WB * Vec3(0, 0, -0.5) - Vec3(0, 3, 0)).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace mechane::pointer
