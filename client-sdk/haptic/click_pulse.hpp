// What a click feels like on a device that renders forces: a short shake.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"
#include "server/hand/hand_force.hpp"

namespace mechane::haptic {

/// A decaying sine for each click that the server tells of: a exp(-t / T) sin(2 pi f t), as for the taps of Okamura, Cutkosky and
/// Dennerlein ("Reality-based models for vibration feedback in virtual environments", 2001), but with one f and T for all materials. Skin
/// hardly tells the direction of a shake; it is up and down. One thread; allocates nothing.
class ClickPulse {
 public:
  static constexpr double kFrequency_hz = 150;  ///< skin feels 250 best, but a device of 1 kHz draws that badly
  static constexpr double kDecay_s = 0.008;
  static constexpr double kEnd_s = 5 * kDecay_s;
  static constexpr double kPeak = 0.82;  ///< of exp(-t / T) sin(2 pi f t)

  /// Call it with each answer. A count that is higher than the last one starts a shake. The first answer starts none, and a lower count
  /// (the hand has come to another world) starts none. While a shake is younger than 20 ms, only a stronger one replaces it.
  void hear(const hand::Clicks& clicks) noexcept {
    constexpr double kApart_s = 0.02;
    const double strength_n = std::clamp(clicks.strength_n, 0.0, hand::kMaxClick_n);
    if (known_ && clicks.count > *known_ && (time_s_ >= kApart_s || strength_n > strength_n_)) {
      strength_n_ = strength_n;
      time_s_ = 0;
    }
    known_ = clicks.count;
  }
  /// Nothing was heard for too long: what has passed meanwhile is not felt now.
  void forget() noexcept { *this = {}; }

  /// The force at the end of the next `dt`, N in W.
  [[nodiscard]] Vec3 render(Duration dt) noexcept {
    if (time_s_ >= kEnd_s) return Vec3::Zero();
    time_s_ += to_seconds(dt);
    const double shake = std::exp(-time_s_ / kDecay_s) * std::sin(2 * kPi * kFrequency_hz * time_s_);
    return strength_n_ / kPeak * shake * Vec3::UnitY();
  }

 private:
  std::optional<std::uint32_t> known_;
  double strength_n_ = 0;
  double time_s_ = kEnd_s;
};

}  // namespace mechane::haptic
