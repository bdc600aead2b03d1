// The hand as the server uses it for contacts: where its segments are for given joint angles. Frames as in
// server/hand/hand_skeleton.hpp. Segment 0 is the palm; then three per finger, from the thumb on, from the palm
// outwards.
#pragma once

#include <array>

#include "server/hand/hand_skeleton.hpp"
#include <mechane/client/types.hpp>

namespace mechane::scene {

[[nodiscard]] const hand::FingerSizes& finger_sizes();

/// Angles of a finger's joints, radians; 0 is flat. Abduction turns about y, flexion towards the palm.
struct FingerBend {
  double aside = 0;
  std::array<double, hand::kPhalanges> flexion{};
};
using HandBend = std::array<FingerBend, client::kFingers>;

using SegmentPoses = std::array<Pose, client::kHandSegments>;

/// Poses of the segments in H.
[[nodiscard]] SegmentPoses place_hand(const HandBend& bend, const hand::HandBuild& build = {});
/// Which hand these segments are of, and its size, wherever it is and however it is bent.
[[nodiscard]] hand::HandBuild build_of(const SegmentPoses& X_S);

/// The centre of a medium hand's finger's round end, in the frame of the poses.
[[nodiscard]] Vec3 finger_tip(const SegmentPoses& X_S, std::size_t finger);

/// A hand that points with its index finger, the other fingers folded.
[[nodiscard]] HandBend pointing_hand();
/// A hand that holds something between thumb and index finger.
[[nodiscard]] HandBend pinching_hand();

}  // namespace mechane::scene
