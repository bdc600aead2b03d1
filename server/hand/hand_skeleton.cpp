#include "server/hand/hand_skeleton.hpp"

namespace mechane::hand {
namespace {

/// How the flat thumb stands against the palm; it bends across it.
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

}  // namespace

FingerSizes middle_sized_fingers() {
  const Quat flat = Quat::Identity();
  return {{
      {{{0.030, -0.006, -0.040}, thumb_stand()}, {0.046, 0.034, 0.028}, {0.0115, 0.0105, 0.0095}},
      {{{0.098, 0.000, -0.031}, flat}, {0.045, 0.026, 0.020}, {0.0095, 0.0085, 0.0075}},
      {{{0.102, 0.000, -0.010}, flat}, {0.050, 0.030, 0.021}, {0.0095, 0.0085, 0.0075}},
      {{{0.099, 0.000, 0.011}, flat}, {0.046, 0.029, 0.021}, {0.0090, 0.0080, 0.0072}},
      {{{0.091, 0.000, 0.031}, flat}, {0.037, 0.021, 0.019}, {0.0085, 0.0075, 0.0065}},
  }};
}

Pose mirrored(const Pose& X) noexcept {
  return {Vec3(X.p.x(), X.p.y(), -X.p.z()), Quat(X.R.w(), -X.R.x(), -X.R.y(), X.R.z())};
}

void place_finger(const FingerSizes& fingers, std::size_t f, const HandBuild& build,
                  std::span<const double, kFingerJoints> angles, const Pose& X_WH,
                  std::span<Pose, kPhalanges> X_WS) noexcept {
  const FingerSize& finger = fingers[f];
  const Quat aside(Eigen::AngleAxisd(angles[0], Vec3::UnitY()));
  Pose X_HJ{build.hand_scale * finger.X_HF.p, finger.X_HF.R * aside};
  if (build.side == HandSide::left) X_HJ = mirrored(X_HJ);  // flexions turn about z, and are the same on both sides
  Pose X_WJ = X_WH * X_HJ;
  for (std::size_t k = 0; k < kPhalanges; ++k) {
    X_WJ.R = X_WJ.R * Quat(Eigen::AngleAxisd(-angles[k + 1], Vec3::UnitZ()));
    const double length = build.length_scale(first_segment(f)) * finger.length_m[k];
    X_WS[k] = X_WJ * Pose{Vec3(0.5 * length, 0, 0), Quat::Identity()};
    X_WJ.p = X_WJ * Vec3(length, 0, 0);
  }
}

}  // namespace mechane::hand
