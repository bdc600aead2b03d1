#include "client-sdk/drivers/joints/hand_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "client-sdk/drivers/cyberglove/calibration.hpp"
#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

constexpr double kJointDegree = std::numbers::pi / 180;

// From child to giant; units or landmarks are wrong beyond them.
constexpr double kShortestPalmM = 0.03, kLongestPalmM = 0.2;
constexpr double kShortestBoneM = 0.002, kLongestBoneM = 0.15;
constexpr double kThinnestPalm =
    0.1;  // sine of the angle between index and little finger, from the wrist: else no plane

// A finger that stands upright on the palm has no abduction to be seen: what trackers see then is their noise of some
// millimetres. This share of a straight finger, squared, draws it to 0.
constexpr double kUnseenAbductionM2 = 4e-6;

// The pads meet while the tips of the bones are still apart.
constexpr double kPinchClosedM = 0.02, kPinchOpenM = 0.05;

struct AngleRange {
  double least_deg, most_deg;
};
using FingerRanges = std::array<AngleRange, kJointsOfFinger>;
constexpr FingerRanges kThumbRanges{{{-60, 60}, {-60, 70}, {-45, 90}, {-45, 100}}};
constexpr FingerRanges kFingerRanges{{{-45, 45}, {-45, 110}, {-20, 130}, {-45, 100}}};

using Axes = std::array<HandPoint, 3>;  // x, y and z of a frame

HandPoint minus(const HandPoint& a, const HandPoint& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
HandPoint plus(const HandPoint& a, const HandPoint& b) noexcept {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
HandPoint cross(const HandPoint& a, const HandPoint& b) noexcept {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
HandPoint times(double factor, const HandPoint& v) noexcept {
  return {factor * v[0], factor * v[1], factor * v[2]};
}
double length_of(const HandPoint& v) noexcept {
  return std::sqrt(dot(v, v));
}
HandPoint unit(const HandPoint& v) noexcept {
  return times(1 / length_of(v), v);
}
HandPoint seen_from(const Axes& axes, const HandPoint& v) noexcept {
  return {dot(axes[0], v), dot(axes[1], v), dot(axes[2], v)};
}

/// How the flat thumb of Mechane's hand stands in H: that of hand::middle_sized_fingers() of the server, which a test compares.
Axes thumb_axes() noexcept {
  const HandPoint x = unit({0.62, -0.30, -0.72});
  const HandPoint towards_palm{0.25, -0.75, 0.60};
  const HandPoint y = unit(minus(times(dot(x, towards_palm), x), towards_palm));
  return {x, y, cross(x, y)};
}

const char* find_palm(const HandDatagram& hand, Axes& palm) noexcept {
  const HandPoint index = minus(hand.points[point_of(1, 0)], hand.points[0]);
  const HandPoint little = minus(hand.points[point_of(4, 0)], hand.points[0]);
  const HandPoint forwards = plus(index, little);
  const double length_m = length_of(forwards) / 2;
  if (length_m < kShortestPalmM || length_m > kLongestPalmM)
    return "its palm is not 3 to 20 cm long; the unit is the metre";
  const HandPoint back = hand.left ? cross(index, little) : cross(little, index);
  if (length_of(back) <= kThinnestPalm * length_of(index) * length_of(little))
    return "its wrist and knuckles lie in one line";
  palm[0] = unit(forwards);
  palm[1] = unit(back);
  palm[2] = cross(palm[0], palm[1]);
  return "";
}

/// The finger's three bones, in the frame that its angles are measured in.
const char* find_bones(const HandDatagram& hand, const Axes& palm, std::size_t finger,
                       std::array<HandPoint, 3>& bones) noexcept {
  for (std::size_t k = 0; k < bones.size(); ++k) {
    const HandPoint bone = minus(hand.points[point_of(finger, k + 1)], hand.points[point_of(finger, k)]);
    const double length_m = length_of(bone);
    if (length_m < kShortestBoneM || length_m > kLongestBoneM) return "a bone of a finger is not 2 mm to 15 cm long";
    bones[k] = seen_from(palm, bone);
    if (hand.left) bones[k][2] = -bones[k][2];
    if (finger == 0) bones[k] = seen_from(thumb_axes(), bones[k]);
  }
  return "";
}

/// The plane through y that is nearest to the bones: its direction is the principal axis of their x and z, since their
/// squared distances from it are least then.
double abduction_of(const std::array<HandPoint, 3>& bones) noexcept {
  double xx = kUnseenAbductionM2, zz = 0, xz = 0;
  for (const HandPoint& bone : bones) {
    xx += bone[0] * bone[0];
    zz += bone[2] * bone[2];
    xz += bone[0] * bone[2];
  }
  return -0.5 * std::atan2(2 * xz, xx - zz);
}

void place_joints(const std::array<HandPoint, 3>& bones, const FingerRanges& ranges, double* joints_rad) noexcept {
  const auto limited_to = [&](std::size_t joint, double angle) {
    joints_rad[joint] =
        std::clamp(angle, ranges[joint].least_deg * kJointDegree, ranges[joint].most_deg * kJointDegree);
  };
  const double abduction = abduction_of(bones);
  limited_to(0, abduction);
  double before_x = 1, before_y = 0;  // the direction that a finger without a bend has, in its plane
  for (std::size_t k = 0; k < bones.size(); ++k) {
    const double x = std::cos(abduction) * bones[k][0] - std::sin(abduction) * bones[k][2];
    const double y = bones[k][1];
    limited_to(k + 1, std::atan2(before_y * x - before_x * y, before_x * x + before_y * y));
    before_x = x;
    before_y = y;
  }
}

double pinch_of(const HandDatagram& hand) noexcept {
  if (hand.pinch) return *hand.pinch;
  const double apart_m = length_of(minus(hand.points[point_of(0, 3)], hand.points[point_of(1, 3)]));
  return std::clamp((kPinchOpenM - apart_m) / (kPinchOpenM - kPinchClosedM), 0.0, 1.0);
}

}  // namespace

const char* place_tracked_hand(const HandDatagram& hand, mechane_device_state& state) noexcept {
  Axes palm;
  mechane_device_state placed = state;
  if (const char* const why = find_palm(hand, palm); *why != '\0') return why;
  for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
    std::array<HandPoint, 3> bones;
    if (const char* const why = find_bones(hand, palm, f, bones); *why != '\0') return why;
    place_joints(bones, f == 0 ? kThumbRanges : kFingerRanges, &placed.joints_rad[kJointsOfFinger * f]);
  }
  std::array<double, 9> R_DH{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      R_DH[3 * row + column] = palm[column][row];
  if (!quaternion_of(R_DH, placed.orientation_wxyz)) return "its palm has no direction";
  std::ranges::copy(hand.points[0], placed.position_m);
  placed.grasp = std::max(grasp_of(placed.joints_rad), pinch_of(hand));
  state = placed;
  return "";
}

}  // namespace mechane::drivers
