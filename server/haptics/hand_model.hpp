// The virtual hand: 16 superquadrics (paper, equation 4), placed from a wrist pose and finger joint angles. A one-point device is a
// single sphere at its tip.
// Frames and angles of a glove hand: server/hand/hand_skeleton.hpp.
#pragma once

#include <array>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/collision/object.hpp"
#include "server/hand/hand_skeleton.hpp"
#include "server/state/input.hpp"
#include "server/state/limits.hpp"

namespace mechane::haptics {

/// Sizes of a hand at scale 1.
struct HandSize {
  Vec3 palm_half_m{hand::kPalmHalfLength_m, 0.014, 0.043};
  hand::FingerSizes fingers = hand::middle_sized_fingers();
  double tip_radius_m = 0.008;      ///< of a one-point device
  double sample_spacing_m = 0.004;  ///< of the points on its surface: under a third of a fingertip's breadth
};

/// Collision objects of right and left hands in six sizes, and their kinematics. Immutable once made; shared by all users of a world.
class HandModel {
 public:
  /// Errors: a size that is not positive or not finite, naming which. Not in the tick.
  [[nodiscard]] static Expected<HandModel> create(const HandSize& size);

  /// Poses of the segments in W, with the hand's own lengths, from kLeastScale to kMostScale of the model's. One-point: only segment 0, a
  /// sphere at the tip. In the tick; any thread.
  void place(const hand::HandSample& sample, const Pose& X_WH,
             std::array<Pose, hand::kHandSegments>& X_WS) const noexcept;

  /// The segment's shape, of the size nearest to its own. It reaches so far over its joints that a finger has no gaps.
  [[nodiscard]] const collision::Object& segment(const hand::HandSample& sample, std::size_t index) const noexcept;
  /// A ball of near_radius_m(): what is in it, placed around a segment's middle, may soon touch the segment.
  [[nodiscard]] const collision::Object& near_ball() const noexcept { return near_ball_; }
  [[nodiscard]] double near_radius_m() const noexcept { return near_ball_.bound_O.radius; }
  /// For smooth_surface().
  [[nodiscard]] const collision::Object& pad() const noexcept { return pad_; }
  /// Of the largest ball inside the segment.
  [[nodiscard]] double inner_radius_m(const hand::HandSample& sample, std::size_t index) const noexcept;
  /// How much farther than that ball the segment reaches from its middle along `n_S`, a unit vector in its frame: along its thinnest
  /// direction not at all.
  [[nodiscard]] double stands_out_m(const hand::HandSample& sample, std::size_t index, const Vec3& n_S) const noexcept;
  /// Around the whole hand, in H: nothing outside can touch it.
  [[nodiscard]] double reach_m(const hand::HandSample& sample) const noexcept;
  /// n_f of equation 19: unit vector perpendicular to a phalanx, out of its back, in W. A glove that only pulls (CyberGrasp)
  /// renders the share of the force along it.
  [[nodiscard]] static Vec3 finger_normal_W(const Pose& X_WS) noexcept { return X_WS.rotate(Vec3::UnitY()); }

  static constexpr std::array<double, 6> kScales{0.55, 0.70, 0.85, 1.0, 1.15, 1.30};
  static constexpr double kLeastScale = 0.5, kMostScale = 1.4;

 private:
  HandModel() = default;
  struct Sized {
    std::vector<collision::Object> right, left;  ///< segments
  };
  [[nodiscard]] static std::size_t nearest_size(double scale) noexcept;

  HandSize size_;
  std::array<Sized, kScales.size()> sizes_;
  collision::Object tip_;
  collision::Object near_ball_;
  collision::Object pad_;
};

}  // namespace mechane::haptics
