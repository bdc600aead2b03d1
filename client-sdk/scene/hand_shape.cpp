#include "client-sdk/scene/hand_shape.hpp"

namespace mechane::scene {
namespace {

constexpr double kDegree = kPi / 180;

FingerBend bent(double first_deg, double second_deg, double third_deg, double aside_deg = 0) {
  return {aside_deg * kDegree, {first_deg * kDegree, second_deg * kDegree, third_deg * kDegree}};
}

}  // namespace

const hand::FingerSizes& finger_sizes() {
  static const hand::FingerSizes kSizes = hand::middle_sized_fingers();
  return kSizes;
}

SegmentPoses place_hand(const HandBend& bend) {
  SegmentPoses X_HS{};
  X_HS[0].p = Vec3(hand::kPalmHalfLength_m, 0, 0);
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    const std::array<double, hand::kFingerJoints> angles{bend[f].aside, bend[f].flexion[0], bend[f].flexion[1],
                                                         bend[f].flexion[2]};
    hand::place_finger(finger_sizes()[f], 1, f == 0 ? hand::thumb_stand() : Quat::Identity(), angles, Pose{},
                       std::span<Pose, hand::kPhalanges>(X_HS.data() + hand::first_segment(f), hand::kPhalanges));
  }
  return X_HS;
}

Vec3 finger_tip(const SegmentPoses& X_S, std::size_t finger) {
  const hand::FingerSize& size = finger_sizes()[finger];
  return X_S[3 + 3 * finger] * Vec3(0.5 * size.length_m[2] - 0.6 * size.radius_m[2], 0, 0);
}

HandBend pointing_hand() {
  return {bent(28, 30, 35), bent(8, 10, 6), bent(72, 88, 40), bent(76, 90, 42), bent(78, 88, 42)};
}

HandBend pinching_hand() {
  return {bent(18, 40, 30, -8), bent(64, 44, 24), bent(66, 52, 28), bent(69, 56, 30), bent(72, 57, 30)};
}

}  // namespace mechane::scene
