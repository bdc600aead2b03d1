// A middle-sized right hand, as the server touches with: sizes, and where its segments are for given joint angles. Frame H: origin at the
// wrist, x towards the fingers, y out of the back of the hand, z away from the thumb. Segment frames S as on the wire: x along the bone, the
// frame in the segment's middle. Segment 0 is the palm, then three a finger, from the thumb on, from the palm outwards.
#pragma once

#include <array>

#include <mechane/client/types.hpp>

namespace mechane::display {

struct FingerSize {
  Vec3 p_HF = Vec3::Zero();  ///< the first joint
  std::array<double, 3> length_m{};
  std::array<double, 3> radius_m{};
};

/// Breadth 85 mm, length 189 mm: thumb, index, middle, ring, little.
inline constexpr double kPalmMiddle_m = 0.050;  ///< along x of H
[[nodiscard]] const std::array<FingerSize, client::kFingers>& finger_sizes();

/// Angles of a finger's joints, radians; 0 is flat. Abduction turns about y, flexion towards the palm.
struct FingerBend {
  double aside = 0;
  std::array<double, 3> flexion{};
};
using HandBend = std::array<FingerBend, client::kFingers>;

using SegmentPoses = std::array<Pose, client::kHandSegments>;

/// Poses of the segments in H.
[[nodiscard]] SegmentPoses place_hand(const HandBend& bend);

/// The middle of a finger's round end, in the frame that the poses are in.
[[nodiscard]] Vec3 finger_tip(const SegmentPoses& X_S, std::size_t finger);

/// A hand that shows at something with its index, the other fingers folded.
[[nodiscard]] HandBend pointing_hand();
/// A hand that holds something between thumb and index.
[[nodiscard]] HandBend pinching_hand();

}  // namespace mechane::display
