// A hand drawn in a few strokes, for a visitor who is to show the same: Mechane's own hand in that pose, seen from the front.
#pragma once

#include <vector>

#include "client-sdk/picture/overlay_content.hpp"
#include "server/hand/calibration_pose.hpp"

namespace mechane::visit {

/// The hand in its glove, fingers up, turned so that the pose is seen best. A left hand is the right one's mirror image.
[[nodiscard]] std::vector<picture::HandStroke> draw_hand(hand::CalibrationPose pose, hand::HandSide side);

}  // namespace mechane::visit
