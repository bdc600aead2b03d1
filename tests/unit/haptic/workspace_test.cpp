#include "client-sdk/haptic/workspace.hpp"

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

constexpr std::uint32_t kSecondButton = 2;

TEST(Workspace, LiesWhereItIsPutAndHasItsScale) {
  Workspace workspace({.place = {.p_WD = Vec3(1, 2, 3), .scale = 4}});
  EXPECT_FALSE(workspace.follow(Vec3(0.01, 0, -0.02), 0));
  EXPECT_TRUE(workspace.p_WH().isApprox(Vec3(1.04, 2, 2.92)));
}

TEST(Workspace, IsTurnedWithItsForces) {
  Workspace workspace({.place = {.turn_rad = kPi / 2}});
  workspace.follow(Vec3(0.1, 0, 0), 0);
  EXPECT_TRUE(workspace.p_WH().isApprox(Vec3(0, 0, -0.1)));
  EXPECT_TRUE(workspace.to_device(Vec3(0, 0, -3)).isApprox(Vec3(3, 0, 0)));
  EXPECT_TRUE((workspace.R_WH(Quat::Identity()) * Vec3(1, 0, 0)).isApprox(Vec3(0, 0, -1)));
}

/// A wall of k N/m in the world is one of k N/m at the device, too.
TEST(Workspace, AWallIsNotStifferForTheScale) {
  constexpr double kWall_n_per_m = 600, kStep_m = 1e-3;
  for (const double scale : {1.0, 3.0}) {
    Workspace workspace({.place = {.scale = scale}});
    workspace.follow(Vec3(0, -kStep_m, 0), 0);
    const double force_n = workspace.to_device(Vec3(0, -kWall_n_per_m * workspace.p_WH().y(), 0)).y();
    EXPECT_LE(force_n, kWall_n_per_m * kStep_m + 1e-12) << scale;
    EXPECT_GT(force_n, 0) << scale;
  }
}

TEST(Workspace, WithTheClutchDownTheHandStaysAndThenGoesOnFromThere) {
  Workspace workspace({.place = {.scale = 2}, .clutch_button = kSecondButton});
  workspace.follow(Vec3(0.10, 0, 0), 0);
  const Vec3 before = workspace.p_WH();
  EXPECT_TRUE(workspace.follow(Vec3(0.05, 0, 0), kSecondButton));
  EXPECT_TRUE(workspace.follow(Vec3(-0.10, 0, 0), kSecondButton | 1));
  EXPECT_TRUE(workspace.p_WH().isApprox(before));
  EXPECT_FALSE(workspace.follow(Vec3(-0.10, 0, 0), 1));
  EXPECT_TRUE(workspace.p_WH().isApprox(before)) << "no jump when it is let go";
  workspace.follow(Vec3(-0.09, 0, 0), 0);
  EXPECT_TRUE(workspace.p_WH().isApprox(before + Vec3(0.02, 0, 0)));
}

TEST(Workspace, WithoutAClutchAllButtonsAreForTheHand) {
  Workspace workspace({});
  EXPECT_FALSE(workspace.follow(Vec3(0.1, 0, 0), 0xffffffffu));
}

TEST(Workspace, WhatIsPutElsewhereForgetsWhatTheClutchMoved) {
  Workspace workspace({.clutch_button = kSecondButton});
  workspace.follow(Vec3(0.1, 0, 0), kSecondButton);
  workspace.put({.p_WD = Vec3(1, 2, 3), .turn_rad = kPi, .scale = 2});
  EXPECT_FALSE(workspace.follow(Vec3(0.1, 0, 0), 0));
  EXPECT_TRUE(workspace.p_WH().isApprox(Vec3(0.8, 2, 3)));
}

}  // namespace
}  // namespace mechane::haptic
