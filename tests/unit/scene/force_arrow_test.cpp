#include "client-sdk/scene/force_arrow.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace mechane::scene {
namespace {

/// The farthest that an arrow reaches along a direction, from a point.
double reach_m(const AssetLibrary& library, const picture::RenderScene& scene, const Vec3& p_W,
               const Vec3& direction_W) {
  double most = 0;
  for (const picture::Instance& part : scene.instances) {
    for (const Vec3f& p_M : library.assets().meshes[part.mesh].positions)
      most = std::max(most, ((part.X_WM * p_M).cast<double>() - p_W).dot(direction_W));
  }
  return most;
}

TEST(ForceArrow, IsAsLongAsTheForceIsLargeAndPointsWhereItPushes) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    return fail(ErrorCode::not_found, "none", "test", "");
  });
  const ForceArrow arrow(library);
  picture::Camera camera;
  camera.p_WC = Vec3(0, 0, 3);
  client::HandPose hand;
  hand.X_WS[0].p = Vec3(0.2, 0.5, 0);
  for (const Vec3& direction_W : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0.6, -0.8, 0)}) {
    for (const double force_n : {0.5, 2.0, 8.0}) {
      hand.force_W = force_n * direction_W;
      picture::RenderScene scene;
      arrow.draw(hand, camera, scene);
      ASSERT_EQ(scene.instances.size(), 2U);
      // Its point; beside the hand, it begins a little towards the camera.
      const double reach = reach_m(library, scene, hand.X_WS[0].p, direction_W);
      const double distance_m = (camera.p_WC - hand.X_WS[0].p).norm();
      EXPECT_NEAR(reach / distance_m, ForceArrow::kLengthPerNewton * force_n + 0.030, 0.005);
    }
  }
  hand.force_W = Vec3(0, 1e4, 0);
  picture::RenderScene most;
  arrow.draw(hand, camera, most);
  EXPECT_LT(reach_m(library, most, hand.X_WS[0].p, Vec3::UnitY()), 3.1 * (ForceArrow::kLongest + 0.04));
}

TEST(ForceArrow, NothingIsShownOfWhatNobodyFeels) {
  AssetLibrary library([](const std::string&) -> Expected<content::ImportedScene> {
    return fail(ErrorCode::not_found, "none", "test", "");
  });
  const ForceArrow arrow(library);
  client::HandPose hand;
  picture::RenderScene scene;
  for (const Vec3& force_W : {Vec3(0, 0, 0), Vec3(0.05, 0, 0), Vec3(std::nan(""), 0, 0)}) {
    hand.force_W = force_W;
    arrow.draw(hand, picture::Camera{}, scene);
  }
  hand.force_W = Vec3(0, 5, 0);
  hand.stale = true;
  arrow.draw(hand, picture::Camera{}, scene);
  EXPECT_TRUE(scene.instances.empty());
}

}  // namespace
}  // namespace mechane::scene
