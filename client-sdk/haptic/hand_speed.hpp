// How fast a hand is, from places that a device tells in the steps of its encoders.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"

namespace mechane::haptic {

/// A step of 55 um in a millisecond looks like 55 mm/s, and what damps by such a speed shakes. So this is the mean over some milliseconds;
/// it is late by half of them. One thread; allocates nothing.
class HandSpeed {
 public:
  static constexpr Duration kOver =
      std::chrono::milliseconds(16);  ///< at up to 4 kHz; for a slow device, one of its steps

  /// A new place, `dt` after the last one: the mean velocity on the way there, in W. Zero at first.
  Twist note(const Pose& X_WH, Duration dt) noexcept {
    ++newest_;
    count_ = std::min(count_ + 1, steps_.size());
    step(0) = {X_WH, std::max(dt, Duration{0})};
    Duration past{0};
    std::size_t back = 0;
    while (back + 1 < count_ && past < kOver)
      past += step(back++).since_before;
    return past > Duration{0} ? mean_twist(step(back).X_WH, X_WH, to_seconds(past)) : Twist{};
  }
  /// The hand was lost: the next place is the first.
  void forget() noexcept { count_ = 0; }

 private:
  struct Step {
    Pose X_WH;
    Duration since_before{0};
  };
  [[nodiscard]] Step& step(std::size_t back) noexcept { return steps_[(newest_ - back) % steps_.size()]; }

  std::array<Step, 65> steps_{};
  std::size_t newest_ = steps_.size(), count_ = 0;
};

}  // namespace mechane::haptic
