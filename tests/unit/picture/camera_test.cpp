#include "client-sdk/picture/camera.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::picture {
namespace {

/// Where a point of W comes out, in -1..1 across and up.
Eigen::Vector2d project(const EyeView& view, const Vec3& p_WQ) {
  const Eigen::Vector4f clip = view.P * view.V_CW * p_WQ.cast<float>().homogeneous();
  return (clip.head<2>() / clip.w()).cast<double>();
}

double any(double low, double high) {
  return low + (high - low) * (*rc::gen::inRange(0, 100'000)) / 100'000.0;
}

RC_GTEST_PROP(Camera, eyes_agree_at_the_screen_and_part_by_similar_triangles, ()) {
  Camera camera;
  camera.p_WC = Vec3::Zero();
  camera.p_WT = Vec3(0, 0, -1);
  camera.eye_distance_m = any(0.03, 0.2);
  camera.screen_distance_m = any(0.5, 10);
  const double depth = any(0.4, 30);
  const Vec3 p_WQ(any(-0.3, 0.3) * depth, any(-0.3, 0.3) * depth, -depth);
  const double aspect = any(0.5, 2.5);
  const Eigen::Vector2d left = project(eye_view(camera, Eye::left, aspect), p_WQ);
  const Eigen::Vector2d right = project(eye_view(camera, Eye::right, aspect), p_WQ);
  // A window at distance D, half width D tan(fov/2) aspect: the eye's ray crosses it e (1 - D/z) further to its own side.
  const double half_width = camera.screen_distance_m * std::tan(camera.field_of_view_rad / 2) * aspect;
  const double disparity = camera.eye_distance_m * (1 - camera.screen_distance_m / depth) / half_width;
  RC_ASSERT(std::abs((right.x() - left.x()) - disparity) < 2e-4);
  RC_ASSERT(std::abs(right.y() - left.y()) < 1e-5);
}

RC_GTEST_PROP(Camera, a_head_that_moves_looks_through_the_same_window, ()) {
  Camera camera;
  camera.p_WC = Vec3(0, 0, any(0.5, 4));
  camera.p_WT = Vec3::Zero();                                                      // the middle of the window
  camera.head_C = camera.p_WC.z() * Vec3(any(-1, 1), any(-1, 1), any(-0.5, 0.5));  // before the window
  camera.eyes_C = Vec3(any(0.5, 1), any(-0.4, 0.4), any(-0.4, 0.4)).normalized();
  const double aspect = any(0.5, 2.5);
  const double half_height = camera.p_WC.z() * std::tan(camera.field_of_view_rad / 2);
  for (const Eye eye : {Eye::left, Eye::right}) {
    const Vec3 p_WE =
        camera.p_WC + camera.head_C + (eye == Eye::left ? -0.5 : 0.5) * camera.eye_distance_m * camera.eyes_C;
    const Vec3 p_WQ(any(-2, 2), any(-2, 2), any(-10, 0.05));
    // Where the ray from the eye to the point crosses the window's plane, z = 0.
    const Vec3 p_WX = p_WE + (p_WQ - p_WE) * (p_WE.z() / (p_WE.z() - p_WQ.z()));
    const Eigen::Vector2d at = project(eye_view(camera, eye, aspect), p_WQ);
    RC_ASSERT(std::abs(at.x() - p_WX.x() / (half_height * aspect)) < 2e-4);
    RC_ASSERT(std::abs(at.y() - p_WX.y() / half_height) < 2e-4);
  }
}

RC_GTEST_PROP(Camera, depth_stays_within_its_budget_on_a_screen_that_is_not_known, ()) {
  Camera camera;
  camera.p_WC = Vec3(0, 0, any(0.4, 6));
  camera.p_WT = Vec3::Zero();
  camera.eye_distance_m = any(0.05, 0.075);
  camera.nearest_m = any(0.2, 1.2) * camera.p_WC.z();
  const double aspect = any(0.8, 2.5);
  const Camera shown = for_screen(camera, {}, nullptr, aspect);
  RC_ASSERT(shown.eye_distance_m <= camera.eye_distance_m);
  const auto parallax = [&](double depth_m) {  // of the picture's width, uncrossed above 0
    const Vec3 p_WQ = shown.p_WC - depth_m * Vec3::UnitZ();
    return (project(eye_view(shown, Eye::right, aspect), p_WQ).x() -
            project(eye_view(shown, Eye::left, aspect), p_WQ).x()) /
           2;
  };
  RC_ASSERT(parallax(300) <= kMostParallaxBehind + 1e-4);
  RC_ASSERT(parallax(camera.nearest_m) >= -kMostParallaxBefore - 1e-4);
  // Not flatter than it must be.
  const bool at_limit =
      parallax(300) > 0.98 * kMostParallaxBehind - 0.0005 || parallax(camera.nearest_m) < -0.99 * kMostParallaxBefore;
  RC_ASSERT(at_limit || shown.eye_distance_m == camera.eye_distance_m);
}

RC_GTEST_PROP(Camera, a_framed_box_is_seen_whole, ()) {
  Eigen::AlignedBox3d box(Vec3(any(-3, 0), any(-1, 0), any(-2, 0)), Vec3(any(0.1, 3), any(0.1, 2), any(0.1, 2)));
  const Camera camera = frame_box(box, Vec3(any(-0.5, 0.5), any(0.05, 0.8), 1), any(0.4, 1.0));
  for (const double aspect : {16.0 / 9, 8.0 / 9, 4.0 / 3}) {
    const EyeView view = eye_view(camera, Eye::middle, aspect);
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector2d at = project(view, box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
      RC_ASSERT(std::abs(at.x()) < 1.0);
      RC_ASSERT(std::abs(at.y()) < 1.0);
    }
  }
}

}  // namespace
}  // namespace mechane::picture
