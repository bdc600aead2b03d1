#include "client-sdk/display/hand_shape.hpp"

namespace mechane::display {
namespace {

constexpr double kDegree = kPi / 180;

/// How the flat thumb stands against the palm, and how it bends: across the palm. As in the server's hand.
Quat thumb_stand() {
  const Vec3 x = Vec3(0.62, -0.30, -0.72).normalized();
  const Vec3 towards_palm(0.25, -0.75, 0.60);
  const Vec3 y = -(towards_palm - x * x.dot(towards_palm)).normalized();
  Mat3 R;
  R.col(0) = x;
  R.col(1) = y;
  R.col(2) = x.cross(y);
  return Quat(R);
}

FingerBend bent(double first_deg, double second_deg, double third_deg, double aside_deg = 0) {
  return {aside_deg * kDegree, {first_deg * kDegree, second_deg * kDegree, third_deg * kDegree}};
}

}  // namespace

const std::array<FingerSize, client::kFingers>& finger_sizes() {
  static const std::array<FingerSize, client::kFingers> kSizes{{
      {{0.030, -0.006, -0.040}, {0.046, 0.034, 0.028}, {0.0115, 0.0105, 0.0095}},
      {{0.098, 0.000, -0.031}, {0.045, 0.026, 0.020}, {0.0095, 0.0085, 0.0075}},
      {{0.102, 0.000, -0.010}, {0.050, 0.030, 0.021}, {0.0095, 0.0085, 0.0075}},
      {{0.099, 0.000, 0.011}, {0.046, 0.029, 0.021}, {0.0090, 0.0080, 0.0072}},
      {{0.091, 0.000, 0.031}, {0.037, 0.021, 0.019}, {0.0085, 0.0075, 0.0065}},
  }};
  return kSizes;
}

SegmentPoses place_hand(const HandBend& bend) {
  SegmentPoses X_HS{};
  X_HS[0].p = Vec3(kPalmMiddle_m, 0, 0);
  for (std::size_t f = 0; f < client::kFingers; ++f) {
    const FingerSize& size = finger_sizes()[f];
    Quat R = (f == 0 ? thumb_stand() : Quat::Identity()) * Quat(Eigen::AngleAxisd(bend[f].aside, Vec3::UnitY()));
    Vec3 joint = size.p_HF;
    for (std::size_t k = 0; k < 3; ++k) {
      R = R * Quat(Eigen::AngleAxisd(-bend[f].flexion[k], Vec3::UnitZ()));
      X_HS[1 + 3 * f + k] = {joint + 0.5 * size.length_m[k] * (R * Vec3::UnitX()), R};
      joint += size.length_m[k] * (R * Vec3::UnitX());
    }
  }
  return X_HS;
}

Vec3 finger_tip(const SegmentPoses& X_S, std::size_t finger) {
  const FingerSize& size = finger_sizes()[finger];
  return X_S[3 + 3 * finger] * Vec3(0.5 * size.length_m[2] - 0.6 * size.radius_m[2], 0, 0);
}

HandBend pointing_hand() {
  return {bent(28, 30, 35), bent(8, 10, 6), bent(72, 88, 40), bent(76, 90, 42), bent(78, 88, 42)};
}

HandBend pinching_hand() {
  return {bent(18, 40, 30, -8), bent(64, 44, 24), bent(66, 52, 28), bent(69, 56, 30), bent(72, 57, 30)};
}

}  // namespace mechane::display
