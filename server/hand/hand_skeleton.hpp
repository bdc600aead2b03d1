// The bones of a right hand: one source for what the server touches with and for what a display shows. Frame H: origin at the wrist, x
// towards the fingers, y out of the back of the hand, z away from the thumb; the palm looks along -y. Frame S of a phalanx: x along the
// bone, y out of its back, the origin in its middle.
#pragma once

#include <array>
#include <span>

#include "server/base/math.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::hand {

/// One finger: where it starts on the palm, its three phalanges from the palm outwards.
struct FingerSize {
  Vec3 p_HF = Vec3::Zero();  ///< the first joint, in H, metres
  std::array<double, kPhalanges> length_m{};
  std::array<double, kPhalanges> radius_m{};
};

/// Thumb, index, middle, ring, little finger.
using FingerSizes = std::array<FingerSize, kFingers>;

/// The fingers of a grown person's middle-sized hand (breadth 85 mm, length 189 mm).
[[nodiscard]] FingerSizes middle_sized_fingers();
/// Its palm: a flat shape whose middle lies half its length in front of the wrist.
inline constexpr double kPalmHalfLength_m = 0.050;

/// How the flat thumb stands against the palm; it bends across it. The other fingers stand as the palm does.
[[nodiscard]] Quat thumb_stand();

/// Places a finger's phalanges. `stand`: thumb_stand(), or none. `angles`: abduction, about y; then three flexions, about -z, towards the
/// palm; radians, 0 is flat. Everything is `scale` times as large. Any thread; allocates nothing.
void place_finger(const FingerSize& finger, double scale, const Quat& stand,
                  std::span<const double, kFingerJoints> angles, const Pose& X_WH,
                  std::span<Pose, kPhalanges> X_WS) noexcept;

}  // namespace mechane::hand
