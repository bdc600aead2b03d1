// The three poses that fit a glove to a visitor's hand, as Mechane's own hand shows them.
#pragma once

#include <array>
#include <cstdint>

#include "server/hand/hand_sample.hpp"

namespace mechane::hand {

/// Of all joints, radians, in the order of HandSample::joints.
using HandAngles = std::array<double, kHandJoints>;

/// What the visitor shows, in the order in which it is asked for.
enum class CalibrationPose : std::uint8_t {
  flat,   ///< the hand flat, its fingers together, the thumb stretched out to the side
  fist,   ///< a fist, the thumb across index and middle finger
  pinch,  ///< the tip of the thumb on the tip of the index finger
};
inline constexpr std::size_t kCalibrationPoses = 3;

/// The flat hand is all zeros. The fist bends the fingers' joints by the ranges of the American Academy of Orthopaedic Surgeons. In the
/// pinch the tips of thumb and index finger touch, and the other fingers are loosely open.
[[nodiscard]] HandAngles model_pose(CalibrationPose pose) noexcept;

}  // namespace mechane::hand
