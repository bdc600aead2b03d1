// Whether the fingers in a glove move: those of a glove that lies on its table do not.
#pragma once

#include <atomic>
#include <cmath>
#include <optional>

#include "server/base/clock.hpp"
#include "server/hand/calibration_pose.hpp"

namespace mechane::haptic {

class HandMotion {
 public:
  static constexpr double kLeast_rad = 0.15;  ///< of one joint; a still hand trembles less

  /// The glove's angles at `now`. True: a joint has moved. One thread; allocates nothing.
  bool note(TimePoint now, const hand::HandAngles& angles) noexcept {
    const bool first = !from_;
    if (!first && !far_from(angles)) return false;
    from_ = angles;
    moved_.store(now, std::memory_order_relaxed);
    return !first;
  }
  /// Since a joint has last moved, or since the first note(). Any thread.
  [[nodiscard]] Duration rests_for(TimePoint now) const noexcept {
    const TimePoint moved = moved_.load(std::memory_order_relaxed);
    return moved == TimePoint{} ? Duration{0} : now - moved;
  }

 private:
  [[nodiscard]] bool far_from(const hand::HandAngles& angles) const noexcept {
    for (std::size_t j = 0; j < angles.size(); ++j)
      if (std::abs(angles[j] - (*from_)[j]) > kLeast_rad) return true;
    return false;
  }

  std::optional<hand::HandAngles> from_;
  std::atomic<TimePoint> moved_{TimePoint{}};
};

}  // namespace mechane::haptic
