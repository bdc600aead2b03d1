#include "server/haptics/hand_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "server/collision/superquadric_object.hpp"
#include "server/haptics/smooth_normal.hpp"

namespace mechane::haptics {
namespace {

using hand::HandKind;

// A phalanx is nearly round across and blunt at its ends; the palm is flat with soft edges.
constexpr double kFingerExponent1 = 0.85;
constexpr double kFingerExponent2 = 0.6;
constexpr double kPalmExponent = 0.5;
// What a hand that is slow enough to feel something, at 0.2 m/s, comes nearer in 100 ms.
constexpr double kNear_m = 0.02;

geometry::Superquadric palm_shape(const HandSize& size, double scale) {
  geometry::Superquadric shape;
  shape.a = scale * size.palm_half_m;
  shape.e1 = kPalmExponent;
  shape.e2 = kPalmExponent;
  return shape;
}

/// Frame S of a phalanx: x along the finger, y out of its back.
geometry::Superquadric phalanx_shape(const hand::FingerSize& finger, std::size_t k, double scale) {
  geometry::Superquadric shape;
  // A phalanx reaches a little over its joints, so that a bent finger has no gaps.
  const double half_length = 0.5 * finger.length_m[k] + 0.5 * finger.radius_m[k];
  shape.a = scale * Vec3(half_length, finger.radius_m[k], finger.radius_m[k]);
  shape.e1 = kFingerExponent1;
  shape.e2 = kFingerExponent2;
  return shape;
}

collision::Object ball(double radius_m, double spacing_m) {
  geometry::Superquadric shape;
  shape.a = Vec3::Constant(radius_m);
  shape.e1 = 1;
  shape.e2 = 1;
  return collision::make_superquadric_object(shape, spacing_m);
}

Expected<void> check(const HandSize& size) {
  const auto bad = [](double v) { return !std::isfinite(v) || v <= 0 || v > 1; };
  const char* remedy = "give sizes in metres, between 0 and 1";
  if (bad(size.palm_half_m.x()) || bad(size.palm_half_m.y()) || bad(size.palm_half_m.z())) {
    return fail(ErrorCode::invalid_value, "the palm's half sizes are not positive lengths", "hand size", remedy);
  }
  for (std::size_t f = 0; f < size.fingers.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (bad(size.fingers[f].length_m[k]) || bad(size.fingers[f].radius_m[k]) || !size.fingers[f].X_HF.p.allFinite()) {
        return fail(ErrorCode::invalid_value,
                    "finger " + std::to_string(f) + ", phalanx " + std::to_string(k) + " has an impossible size",
                    "hand size", remedy);
      }
    }
  }
  if (bad(size.tip_radius_m) || bad(size.sample_spacing_m)) {
    return fail(ErrorCode::invalid_value, "the tip radius or the sample spacing is not a positive length", "hand size",
                remedy);
  }
  return {};
}

/// With lengths for which there are shapes.
hand::HandBuild placeable(const hand::HandBuild& own) {
  hand::HandBuild build = own;
  const auto limited = [](double scale) { return std::clamp(scale, HandModel::kLeastScale, HandModel::kMostScale); };
  build.hand_scale = limited(build.hand_scale);
  for (double& scale : build.finger_scale)
    scale = limited(build.hand_scale * scale) / build.hand_scale;
  return build;
}

}  // namespace

Expected<HandModel> HandModel::create(const HandSize& size) {
  if (auto ok = check(size); !ok) return tl::unexpected(ok.error());
  HandModel model;
  model.size_ = size;
  for (std::size_t s = 0; s < kScales.size(); ++s) {
    const double scale = kScales[s];
    Sized& sized = model.sizes_[s];
    sized.right.push_back(collision::make_superquadric_object(palm_shape(size, scale), size.sample_spacing_m));
    for (const hand::FingerSize& finger : size.fingers) {
      for (std::size_t k = 0; k < 3; ++k) {
        sized.right.push_back(
            collision::make_superquadric_object(phalanx_shape(finger, k, scale), size.sample_spacing_m));
      }
    }
    std::ranges::transform(sized.right, std::back_inserter(sized.left), collision::mirrored);
  }
  // The tip is small and alone: it can afford a finer skin than a hand.
  model.tip_ = ball(size.tip_radius_m, 0.75 * size.sample_spacing_m);
  // Few points: the surface samples of the bodies in the ball count too.
  model.near_ball_ = ball(size.tip_radius_m + kNear_m, 2 * size.sample_spacing_m);
  model.pad_ = make_pad();
  return model;
}

std::size_t HandModel::nearest_size(double scale) noexcept {
  std::size_t best = 0;
  for (std::size_t i = 1; i < kScales.size(); ++i) {
    if (std::abs(kScales[i] - scale) < std::abs(kScales[best] - scale)) best = i;
  }
  return best;
}

const collision::Object& HandModel::segment(const hand::HandSample& sample, std::size_t index) const noexcept {
  if (sample.kind == HandKind::one_point) return tip_;
  const Sized& of_size = sizes_[nearest_size(sample.length_scale(index))];
  return sample.side == hand::HandSide::left ? of_size.left[index] : of_size.right[index];
}

double HandModel::inner_radius_m(const hand::HandSample& sample, std::size_t index) const noexcept {
  if (sample.kind == HandKind::one_point) return size_.tip_radius_m;
  const double scale = kScales[nearest_size(sample.length_scale(index))];
  if (index == 0) return scale * size_.palm_half_m.minCoeff();
  return scale * size_.fingers[hand::finger_of(index)].radius_m[(index - 1) % hand::kPhalanges];
}

double HandModel::stands_out_m(const hand::HandSample& sample, std::size_t index, const Vec3& n_S) const noexcept {
  if (sample.kind == HandKind::one_point) return 0;
  // The norm that is dual to that of which the superquadric is the unit ball.
  const geometry::Superquadric& shape = segment(sample, index).parts.front().superquadric;
  const double across = 2 / (2 - shape.e2), along = 2 / (2 - shape.e1);
  const Vec3 stretched_m = shape.a.cwiseProduct(n_S).cwiseAbs();
  const double section = std::pow(stretched_m.x(), across) + std::pow(stretched_m.y(), across);
  const double whole = std::pow(section, along / across) + std::pow(stretched_m.z(), along);
  return std::pow(whole, 1 / along) - inner_radius_m(sample, index);
}

double HandModel::reach_m(const hand::HandSample& sample) const noexcept {
  if (sample.kind == HandKind::one_point) return size_.tip_radius_m * kMostScale;
  double reach = 2 * size_.palm_half_m.x();
  for (const hand::FingerSize& finger : size_.fingers) {
    const double length = finger.length_m[0] + finger.length_m[1] + finger.length_m[2];
    reach = std::max(reach, finger.X_HF.p.norm() + length + finger.radius_m[0]);
  }
  return reach * kMostScale;
}

void HandModel::place(const hand::HandSample& sample, const Pose& X_WH,
                      std::array<Pose, hand::kHandSegments>& X_WS) const noexcept {
  if (sample.kind == HandKind::one_point) {
    X_WS[0] = X_WH;
    return;
  }
  const hand::HandBuild build = placeable(sample);
  X_WS[0] = X_WH * Pose{Vec3(build.hand_scale * size_.palm_half_m.x(), 0, 0), Quat::Identity()};
  for (std::size_t f = 0; f < hand::kFingers; ++f) {
    hand::place_finger(size_.fingers, f, build,
                       std::span<const double, hand::kFingerJoints>(sample.joints.data() + hand::kFingerJoints * f,
                                                                    hand::kFingerJoints),
                       X_WH, std::span<Pose, hand::kPhalanges>(X_WS.data() + hand::first_segment(f), hand::kPhalanges));
  }
}

}  // namespace mechane::haptics
