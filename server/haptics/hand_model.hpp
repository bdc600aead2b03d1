// The virtual hand: 16 superquadrics (paper, equation 4), placed from a wrist pose and finger joint angles. A one-point device is a
// single sphere at its tip.
//
// Frame H of a glove hand (a right hand): origin at the wrist, x towards the fingers, y out of the back of the hand, z to the right,
// away from the thumb. The palm looks along -y. Angles: abduction turns about y, flexion about -z towards the palm; 0 is a flat hand.
#pragma once

#include <array>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/collision/object.hpp"
#include "server/state/input.hpp"
#include "server/state/limits.hpp"

namespace mechane::haptics {

/// One finger: where it starts on the palm, its three phalanges from the palm outwards.
struct FingerSize {
  Vec3 p_HF = Vec3::Zero();  ///< the first joint, in H, metres
  std::array<double, 3> length_m{};
  std::array<double, 3> radius_m{};
};

/// Sizes of a hand at scale 1: a grown person's middle-sized hand (breadth 85 mm, length 189 mm).
struct HandSize {
  Vec3 palm_half_m{0.050, 0.014, 0.043};
  std::array<FingerSize, state::kFingers> fingers{{
      {{0.030, -0.006, -0.040}, {0.046, 0.034, 0.028}, {0.0115, 0.0105, 0.0095}},
      {{0.098, 0.000, -0.031}, {0.045, 0.026, 0.020}, {0.0095, 0.0085, 0.0075}},
      {{0.102, 0.000, -0.010}, {0.050, 0.030, 0.021}, {0.0095, 0.0085, 0.0075}},
      {{0.099, 0.000, 0.011}, {0.046, 0.029, 0.021}, {0.0090, 0.0080, 0.0072}},
      {{0.091, 0.000, 0.031}, {0.037, 0.021, 0.019}, {0.0085, 0.0075, 0.0065}},
  }};
  double tip_radius_m = 0.008;      ///< of a one-point device
  double sample_spacing_m = 0.004;  ///< of the points on its surface: under a third of a fingertip's breadth
};

/// Collision objects of a hand in five sizes, and its kinematics. Immutable once made; shared by all users of a world.
class HandModel {
 public:
  /// Errors: a size that is not positive or not finite, naming which. Not in the tick.
  [[nodiscard]] static Expected<HandModel> create(const HandSize& size);

  /// Poses of the segments in W. One-point: only segment 0, a sphere at the tip. In the tick; any thread.
  void place(const state::HandSample& sample, const Pose& X_WH,
             std::array<Pose, state::kHandSegments>& X_WS) const noexcept;

  /// Segments that a hand of this kind has: 16 or 1.
  [[nodiscard]] static std::size_t segment_count(state::HandKind kind) noexcept;
  /// The segment's shape, of the size nearest to the sample's hand_scale.
  [[nodiscard]] const collision::Object& segment(const state::HandSample& sample, std::size_t index) const noexcept;
  /// Around the whole hand, in H: nothing outside can touch it.
  [[nodiscard]] double reach_m(const state::HandSample& sample) const noexcept;
  /// n_f of equation 19: unit vector perpendicular to a phalanx, out of its back, in W. A glove that only pulls (CyberGrasp)
  /// renders the share of the force along it.
  [[nodiscard]] static Vec3 finger_normal_W(const Pose& X_WS) noexcept { return X_WS.rotate(Vec3::UnitY()); }

  static constexpr std::array<double, 5> kScales{0.70, 0.85, 1.0, 1.15, 1.30};

 private:
  HandModel() = default;
  struct Sized {
    std::vector<collision::Object> segments;
    collision::Object tip;
  };
  [[nodiscard]] static std::size_t nearest_size(double scale) noexcept;

  HandSize size_;
  Quat thumb_base_ = Quat::Identity();  ///< how the flat thumb stands against the palm
  std::array<Sized, kScales.size()> sizes_;
};

}  // namespace mechane::haptics
