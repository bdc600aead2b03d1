// Where the joints of a hand are, as a tracker sees them: for simulated trackers.
#pragma once

#include <array>
#include <span>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::haptic {

/// Mechane's hand in a pose: a left hand is the mirror image.
struct SeenHand {
  std::array<double, hand::kHandJoints> joints_rad{};
  Pose X_DH{Vec3(0.1, 0.2, -0.3), Quat::Identity()};  ///< somewhere before the tracker
  bool left = false;
  double scale = 1;

  [[nodiscard]] Vec3 in_D(const Vec3& p_H) const { return X_DH * Vec3(p_H.x(), p_H.y(), left ? -p_H.z() : p_H.z()); }
  /// From the palm to the tip.
  [[nodiscard]] std::array<Vec3, 4> finger_D(std::size_t f) const {
    const hand::FingerSize size = hand::middle_sized_fingers()[f];
    std::array<Pose, hand::kPhalanges> X_HS;
    hand::place_finger(size, scale, f == 0 ? hand::thumb_stand() : Quat::Identity(),
                       std::span<const double, 4>(&joints_rad[4 * f], 4), Pose{}, X_HS);
    std::array<Vec3, 4> points;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 half(scale * size.length_m[k] / 2, 0, 0);
      points[k] = in_D(X_HS[k] * -half);
      points[k + 1] = in_D(X_HS[k] * half);
    }
    return points;
  }
};

}  // namespace mechane::haptic
