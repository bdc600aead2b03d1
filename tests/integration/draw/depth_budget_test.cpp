// How deep the places are for two eyes, vertex by vertex: what visitors see is comfortable on a screen that nobody measured.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/recorded_place.hpp"

namespace mechane::draw {
namespace {

constexpr double kAspect = 16.0 / 9;

struct DepthOfPlace {
  double behind = 0;  ///< the most of what is seen, of the picture's width
  double before = 0;
};

/// Of the vertices that both eyes see.
DepthOfPlace depth_of(const picture::RenderScene& scene, const picture::SceneAssets& assets) {
  const picture::EyeView left = picture::eye_view(scene.camera, picture::Eye::left, kAspect);
  const picture::EyeView right = picture::eye_view(scene.camera, picture::Eye::right, kAspect);
  DepthOfPlace depth;
  for (const picture::Instance& instance : scene.instances) {
    for (const Vec3f& p_M : assets.meshes[instance.mesh].positions) {
      const Vec3f p_W = instance.X_WM * p_M;
      const auto at = [&](const picture::EyeView& eye) {
        return Eigen::Vector4f(eye.P * eye.V_CW * p_W.homogeneous());
      };
      const Eigen::Vector4f l = at(left), r = at(right);
      const auto is_seen = [](const Eigen::Vector4f& c) {
        return c.w() > 0 && std::abs(c.x()) < c.w() && std::abs(c.y()) < c.w() && c.z() > -c.w();
      };
      if (!is_seen(l) || !is_seen(r)) continue;
      const double uncrossed = static_cast<double>(r.x() / r.w() - l.x() / l.w()) / 2;
      depth.behind = std::max(depth.behind, uncrossed);
      depth.before = std::max(depth.before, -uncrossed);
    }
  }
  return depth;
}

class DepthBudget : public testing::TestWithParam<const char*> {};

TEST_P(DepthBudget, is_kept_at_each_moment_of_a_visit) {
  mechane::test::RecordedPlace place(GetParam());
  for (int second = 0; second < 4; ++second) {
    const picture::RenderScene scene = place.scene(second, kAspect);
    const DepthOfPlace depth = depth_of(scene, place.assets());
    EXPECT_LE(depth.behind, picture::kMostParallaxBehind + 1e-4) << "moment " << second;
    EXPECT_LE(depth.before, picture::kMostParallaxBefore + 1e-4) << "moment " << second;
    EXPECT_GT(depth.behind + depth.before, 0.008) << "moment " << second << ": flat";
  }
}

INSTANTIATE_TEST_SUITE_P(Places, DepthBudget,
                         testing::Values("village", "archimedes-screw", "ktesibios-pump", "pulley-crane",
                                         "compound-pulley-crane", "catapult", "crossbow", "aiolos-sphere", "odometer"));

}  // namespace
}  // namespace mechane::draw
