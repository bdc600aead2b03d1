// A servo that stops a finger's string: where it must stop so that the finger opens and does not close.
#pragma once

#include <cmath>
#include <limits>

#include "client-sdk/drivers/lucidgloves/alpha.hpp"

namespace mechane::drivers {

/// Holds each finger where it was when its brake came on, or where it has opened to since. One thread.
class FingerBrakes {
 public:
  /// `finger_n` over 0: the finger is held. Zero, less, and what is not a number release it.
  const StringLimits& follow(const std::array<double, MECHANE_FINGERS>& curl,
                             const double (&finger_n)[MECHANE_FINGERS]) noexcept {
    for (std::size_t f = 0; f < MECHANE_FINGERS; ++f) {
      if (!(finger_n[f] > 0))
        held_[f] = kFree;
      else if (curl[f] < held_[f] - kNoise)
        held_[f] = curl[f];
      limits_[f] = held_[f] == kFree ? 0 : static_cast<int>(std::lround(1000 * (1 - held_[f])));
    }
    return limits_;
  }

 private:
  static constexpr double kFree = std::numeric_limits<double>::infinity();
  // A stop that followed every flicker of a potentiometer towards open would pull the finger open bit by bit.
  static constexpr double kNoise = 0.02;

  std::array<double, MECHANE_FINGERS> held_{kFree, kFree, kFree, kFree, kFree};  // the curl at which the string stops
  StringLimits limits_{};
};

}  // namespace mechane::drivers
