#include "server/hand/calibration_pose.hpp"

#include <gtest/gtest.h>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::hand {
namespace {

Vec3 middle_of_round_end(std::size_t finger, const HandAngles& angles) {
  const FingerSizes sizes = middle_sized_fingers();
  const FingerSize& size = sizes[finger];
  std::array<Pose, kPhalanges> X_HS;
  place_finger(sizes, finger, {},
               std::span<const double, kFingerJoints>(&angles[kFingerJoints * finger], kFingerJoints), Pose{}, X_HS);
  return X_HS.back() * Vec3((size.length_m.back() - size.radius_m.back()) / 2, 0, 0);
}

TEST(CalibrationPose, TheTipsTouchInThePinch) {
  const HandAngles pinch = model_pose(CalibrationPose::pinch);
  const FingerSizes sizes = middle_sized_fingers();
  EXPECT_NEAR((middle_of_round_end(0, pinch) - middle_of_round_end(1, pinch)).norm(),
              sizes[0].radius_m.back() + sizes[1].radius_m.back(), 1e-4);
}

TEST(CalibrationPose, TheFistIsClosedAndTheFlatHandOpen) {
  for (std::size_t f = 1; f < kFingers; ++f) {
    const Vec3 open = middle_of_round_end(f, model_pose(CalibrationPose::flat));
    const Vec3 closed = middle_of_round_end(f, model_pose(CalibrationPose::fist));
    EXPECT_NEAR(open.y(), 0, 1e-12);
    EXPECT_LT(closed.x(), open.x() - 0.07) << f;
    EXPECT_LT(closed.y(), -0.01) << "on the palm's side";
  }
}

}  // namespace
}  // namespace mechane::hand
