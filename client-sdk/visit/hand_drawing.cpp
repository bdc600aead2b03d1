#include "client-sdk/visit/hand_drawing.hpp"

#include <algorithm>
#include <array>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::visit {
namespace {

using hand::CalibrationPose;
using picture::HandStroke;

constexpr double kDegree = kPi / 180;
constexpr double kPalmThickness_m = 0.013;  // half
constexpr double kPlump = 1.12;             // fingers, to be seen from afar

/// A palm or a finger: its strokes, and how near it is to the viewer.
struct Part {
  std::vector<HandStroke> strokes;
  double nearness = 0;
};

/// From the viewer: x to the right, y up, z towards the viewer.
struct View {
  Quat R_VH;
  Vec3 p_HC;              ///< of the hand, in the middle of the disc
  double disc_per_m = 1;  ///< the drawing's size

  [[nodiscard]] Vec3 see(const Vec3& p_H) const { return R_VH * (p_H - p_HC); }
  void add(Part& part, const Vec3& from_H, const Vec3& to_H, double radius_m) const {
    const auto on_disc = [this](const Vec3& p_H) {
      const Vec3 p_V = disc_per_m * see(p_H);
      return Eigen::Vector2f(static_cast<float>(p_V.x()), static_cast<float>(-p_V.y()));
    };
    part.strokes.push_back({on_disc(from_H), on_disc(to_H), static_cast<float>(disc_per_m * radius_m)});
    part.nearness = std::max(part.nearness, see(from_H).z() + radius_m);
    part.nearness = std::max(part.nearness, see(to_H).z() + radius_m);
  }
};

/// Fingers up, and the palm towards the viewer before the hand is turned about its fingers.
View view_of(CalibrationPose pose) {
  const bool fist = pose == CalibrationPose::fist;
  Mat3 R_VH;
  R_VH << -Vec3::UnitZ().transpose(), Vec3::UnitX().transpose(), -Vec3::UnitY().transpose();
  // A fist shows its thumb across the fingers, and a pinch the ring that it makes.
  const double turned_deg = fist ? -20 : pose == CalibrationPose::pinch ? -130 : 0;
  const Quat turn(Eigen::AngleAxisd(turned_deg * kDegree, Vec3::UnitY()));
  return {turn * Quat(R_VH), {fist ? 0.048 : 0.073, 0, -0.01}, fist ? 8.0 : 6.2};
}

Part palm_of(const View& view) {
  Part palm;
  const auto sizes = hand::middle_sized_fingers();
  view.add(palm, Vec3(-0.01, 0, 0), Vec3(0.012, 0, 0), 0.023);
  for (std::size_t f = 1; f < hand::kFingers; ++f) {
    const Vec3 knuckle = sizes[f].X_HF.p - Vec3(kPalmThickness_m, 0, 0);
    view.add(palm, Vec3(0.025, 0, 0.45 * knuckle.z()), knuckle, kPalmThickness_m);
  }
  view.add(palm, sizes[0].X_HF.p, Vec3(0.078, 0, -0.026), 0.011);
  view.add(palm, Vec3(0.02, 0, 0.016), Vec3(0.07, 0, 0.026), 0.016);
  palm.nearness = 0;  // fingers that are bent lie before it
  return palm;
}

Part finger_of(const View& view, std::size_t f, const hand::HandAngles& angles) {
  const hand::FingerSizes sizes = hand::middle_sized_fingers();
  const hand::FingerSize& size = sizes[f];
  std::array<Pose, hand::kPhalanges> X_HS;
  hand::place_finger(sizes, f, {}, std::span<const double, hand::kFingerJoints>(&angles[hand::kFingerJoints * f], 4),
                     Pose{}, X_HS);
  Part finger;
  for (std::size_t k = 0; k < hand::kPhalanges; ++k) {
    const Vec3 half(size.length_m[k] / 2, 0, 0);
    const Vec3 end = k + 1 < hand::kPhalanges ? half : half - Vec3(0.5 * size.radius_m[k], 0, 0);
    view.add(finger, X_HS[k] * -half, X_HS[k] * end, kPlump * size.radius_m[k]);
  }
  return finger;
}

/// Of the glove.
Part cuff_of(const View& view) {
  Part cuff;
  view.add(cuff, Vec3(-0.03, 0, -0.022), Vec3(-0.03, 0, 0.022), 0.011);
  return cuff;
}

}  // namespace

std::vector<HandStroke> draw_hand(CalibrationPose pose, hand::HandSide side) {
  const View view = view_of(pose);
  const hand::HandAngles angles = hand::model_pose(pose);
  std::vector<Part> parts{palm_of(view), cuff_of(view)};
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    parts.push_back(finger_of(view, f, angles));
  std::ranges::stable_sort(parts, {}, &Part::nearness);
  std::vector<HandStroke> all;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (HandStroke stroke : parts[p].strokes) {
      stroke.part = p;
      if (side == hand::HandSide::left) stroke.from.x() = -stroke.from.x(), stroke.to.x() = -stroke.to.x();
      all.push_back(stroke);
    }
  }
  return all;
}

}  // namespace mechane::visit
