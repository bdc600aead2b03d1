// Whether the hand in a glove moves: that of a glove that lies on its table does not.
#pragma once

#include <atomic>
#include <cmath>
#include <optional>

#include "server/base/clock.hpp"
#include "server/hand/calibration_pose.hpp"

namespace mechane::haptic {

class HandMotion {
 public:
  static constexpr double kLeast_rad = 0.15;  ///< of one joint, or of the wrist; a still hand trembles less
  static constexpr double kLeast_m = 0.02;    ///< of the wrist at the device

  /// `scale`: metres in the world for one of the device's.
  explicit HandMotion(double scale = 1) : least_m_(kLeast_m * scale) {}

  /// The glove's angles at `now`, and its wrist's place where that counts. True: a joint or the wrist has moved. One thread; allocates
  /// nothing.
  bool note(TimePoint now, const hand::HandAngles& angles, const Pose& X_WH = {}) noexcept {
    const bool first = !from_;
    if (!first && !far_from(angles, X_WH)) return false;
    from_ = angles;
    X_WH_from_ = X_WH;
    moved_.store(now, std::memory_order_relaxed);
    return !first;
  }
  /// Since a joint or the wrist has last moved, or since the first note(). Any thread.
  [[nodiscard]] Duration rests_for(TimePoint now) const noexcept {
    const TimePoint moved = moved_.load(std::memory_order_relaxed);
    return moved == TimePoint{} ? Duration{0} : now - moved;
  }

 private:
  [[nodiscard]] bool far_from(const hand::HandAngles& angles, const Pose& X_WH) const noexcept {
    const Twist wrist = mean_twist(X_WH_from_, X_WH, 1);  // in one second: its length is the way
    if (wrist.v.norm() > least_m_ || wrist.w.norm() > kLeast_rad) return true;
    for (std::size_t j = 0; j < angles.size(); ++j)
      if (std::abs(angles[j] - (*from_)[j]) > kLeast_rad) return true;
    return false;
  }

  double least_m_;
  std::optional<hand::HandAngles> from_;
  Pose X_WH_from_;
  std::atomic<TimePoint> moved_{TimePoint{}};
};

}  // namespace mechane::haptic
