// A hand as a tracker sees it: points where its joints are.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::test {

/// Mechane's hand in a pose, as a tracker sees it: a left hand is the mirror image.
struct SeenHand {
  std::array<double, hand::kHandJoints> joints_rad{};
  Pose X_DH{Vec3(0.1, 0.2, -0.3), Quat::Identity()};
  bool left = false;
  double scale = 1;

  [[nodiscard]] Vec3 in_D(const Vec3& p_H) const { return X_DH * Vec3(p_H.x(), p_H.y(), left ? -p_H.z() : p_H.z()); }
  /// From the palm to the tip.
  [[nodiscard]] std::array<Vec3, 4> finger(std::size_t f) const {
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
  /// In the order of a format, and in its axes.
  [[nodiscard]] std::vector<Vec3> points(const std::string& format) const {
    std::vector<Vec3> all{in_D(Vec3::Zero())};
    if (format == "openxr") all.insert(all.begin(), in_D(Vec3(0.05, 0, 0)));
    for (std::size_t f = 0; f < hand::kFingers; ++f) {
      const auto joints = finger(f);
      if (f > 0 && format != "mediapipe") all.push_back(in_D(0.2 * scale * hand::middle_sized_fingers()[f].p_HF));
      all.insert(all.end(), joints.begin(), joints.end());
    }
    if (format == "mediapipe")
      for (Vec3& p : all)
        p = Vec3(p.x(), -p.y(), -p.z());
    return all;
  }
};

}  // namespace mechane::test
