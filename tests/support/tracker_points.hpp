// What a tracker sends of a hand.
#pragma once

#include <string>
#include <vector>

#include "client-sdk/haptic/seen_hand.hpp"

namespace mechane::test {

/// In the order of a format, and in its axes.
inline std::vector<Vec3> tracker_points(const haptic::SeenHand& hand, const std::string& format) {
  std::vector<Vec3> all{hand.in_D(Vec3::Zero())};
  if (format == "openxr") all.insert(all.begin(), hand.in_D(Vec3(0.05, 0, 0)));
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    const auto joints = hand.finger_D(f);
    if (f > 0 && format != "mediapipe") all.push_back(hand.in_D(0.2 * hand.sizes[f].X_HF.p));
    all.insert(all.end(), joints.begin(), joints.end());
  }
  if (format == "mediapipe")
    for (Vec3& p : all)
      p = Vec3(p.x(), -p.y(), -p.z());
  return all;
}

}  // namespace mechane::test
