// Where the joints of a hand are, as a tracker sees them: for simulated trackers.
#pragma once

#include <array>
#include <span>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::haptic {

/// Mechane's hand in a pose, or one of other sizes.
struct SeenHand {
  std::array<double, hand::kHandJoints> joints_rad{};
  Pose X_DH{Vec3(0.1, 0.2, -0.3), Quat::Identity()};  ///< somewhere before the tracker
  hand::HandBuild build;
  hand::FingerSizes sizes = hand::middle_sized_fingers();  ///< before they are scaled

  [[nodiscard]] bool left() const { return build.side == hand::HandSide::left; }
  /// A place of the right hand's, where this one has it.
  [[nodiscard]] Vec3 in_D(const Vec3& p_H) const {
    const Pose there{build.hand_scale * p_H, Quat::Identity()};
    return X_DH * (left() ? hand::mirrored(there) : there).p;
  }
  /// From the palm to the tip.
  [[nodiscard]] std::array<Vec3, 4> finger_D(std::size_t f) const {
    std::array<Pose, hand::kPhalanges> X_DS;
    hand::place_finger(sizes, f, build, std::span<const double, 4>(&joints_rad[4 * f], 4), X_DH, X_DS);
    std::array<Vec3, 4> points;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 half(build.length_scale(hand::first_segment(f)) * sizes[f].length_m[k] / 2, 0, 0);
      points[k] = X_DS[k] * -half;
      points[k + 1] = X_DS[k] * half;
    }
    return points;
  }
};

}  // namespace mechane::haptic
