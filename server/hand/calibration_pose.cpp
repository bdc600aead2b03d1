#include "server/hand/calibration_pose.hpp"

namespace mechane::hand {
namespace {

constexpr double kDegree = kPi / 180;

/// In degrees.
constexpr std::array<HandAngles, kCalibrationPoses> kModelPoses{{
    {},
    {-20, 25, 40, 60, 0, 90, 100, 90, 0, 90, 100, 90, 0, 90, 100, 90, 0, 90, 100, 90},
    {-8, 18, 40, 30, 0, 62, 42, 24, 0, 12, 12, 10, 0, 8, 10, 8, 0, 6, 8, 6},
}};

}  // namespace

HandAngles model_pose(CalibrationPose pose) noexcept {
  HandAngles angles = kModelPoses[static_cast<std::size_t>(pose)];
  for (double& angle : angles)
    angle *= kDegree;
  return angles;
}

}  // namespace mechane::hand
