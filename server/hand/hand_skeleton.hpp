// The bones of a hand: one source for what the server touches with and for what a display shows. Frame H: origin at the wrist, x towards
// the fingers, y out of the back of the hand; the palm looks along -y. z points away from the thumb of a right hand, and towards that of a
// left one, which is the right one's mirror image at z = 0. Frame S of a phalanx: x along the bone, y out of its back, the origin in its
// middle.
#pragma once

#include <array>
#include <span>

#include "server/base/math.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::hand {

/// One finger of a right hand: where it starts on the palm, its three phalanges from the palm outwards.
struct FingerSize {
  Pose X_HF;  ///< the first joint, and how the flat finger stands there; a thumb bends across the palm
  std::array<double, kPhalanges> length_m{};
  std::array<double, kPhalanges> radius_m{};
};

/// Thumb, index, middle, ring, little finger.
using FingerSizes = std::array<FingerSize, kFingers>;

/// The fingers of a grown person's middle-sized hand (breadth 85 mm, length 189 mm).
[[nodiscard]] FingerSizes middle_sized_fingers();
/// Its palm: a flat shape whose middle lies half its length in front of the wrist.
inline constexpr double kPalmHalfLength_m = 0.050;
/// Its length from the wrist to the tip of the middle finger.
inline constexpr double kHandLength_m = 0.189;

/// In a mirror at z = 0.
[[nodiscard]] Pose mirrored(const Pose& X) noexcept;

/// Places the phalanges of finger `f`. `angles`: abduction, towards the thumb; then three flexions, towards the palm; radians, 0 is flat.
/// Those of a left hand are the ones of the right hand that is its mirror image. Any thread; allocates nothing.
void place_finger(const FingerSizes& fingers, std::size_t f, const HandBuild& build,
                  std::span<const double, kFingerJoints> angles, const Pose& X_WH,
                  std::span<Pose, kPhalanges> X_WS) noexcept;

}  // namespace mechane::hand
