#include "client-sdk/scene/hand_shape.hpp"

#include <algorithm>

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

SegmentPoses place_hand(const HandBend& bend, const hand::HandBuild& build) {
  SegmentPoses X_HS{};
  X_HS[0].p = Vec3(build.hand_scale * hand::kPalmHalfLength_m, 0, 0);
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    const std::array<double, hand::kFingerJoints> angles{bend[f].aside, bend[f].flexion[0], bend[f].flexion[1],
                                                         bend[f].flexion[2]};
    hand::place_finger(finger_sizes(), f, build, angles, Pose{},
                       std::span<Pose, hand::kPhalanges>(X_HS.data() + hand::first_segment(f), hand::kPhalanges));
  }
  return X_HS;
}

hand::HandBuild build_of(const SegmentPoses& X_S) {
  std::array<double, client::kFingers> lengths{};
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    // Two phalanges meet at a joint, half the length of each from its middle.
    const std::size_t first = hand::first_segment(f);
    const auto half = [&](std::size_t k) { return Vec3(0.5 * finger_sizes()[f].length_m[k], 0, 0); };
    const Vec3 apart = X_S[first].rotate(half(0)) + X_S[first + 1].rotate(half(1));
    lengths[f] = (X_S[first + 1].p - X_S[first].p).norm() / std::max(apart.norm(), 1e-3);
  }
  const Pose X_PS = X_S[0].inverse();
  // The index finger's first joint, from the palm's middle.
  const hand::FingerSize& index = finger_sizes()[1];
  const Vec3 joint_P = X_PS * (X_S[hand::first_segment(1)] * Vec3(-0.5 * lengths[1] * index.length_m[0], 0, 0));
  const double there_m = (index.X_HF.p - Vec3(hand::kPalmHalfLength_m, 0, 0)).norm();
  hand::HandBuild build;
  build.side = (X_PS * X_S[hand::first_segment(0)].p).z() > 0 ? client::HandSide::left : client::HandSide::right;
  build.hand_scale = std::clamp(joint_P.norm() / there_m, hand::kMinHandScale, hand::kMaxHandScale);
  for (std::size_t f = 0; f < client::kFingers; ++f)
    build.finger_scale[f] = std::clamp(lengths[f] / build.hand_scale, hand::kMinFingerScale, hand::kMaxFingerScale);
  return build;
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
