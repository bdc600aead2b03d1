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

/// A decaying sine for each click that the server tells of, as Okamura, Cutkosky and Dennerlein (2001) render a tap. The hand's skin does
/// not tell its direction: up and down. One thread; allocates nothing.
class ClickPulse {
 public:
  static constexpr double kFrequency_hz = 150;  ///< about where skin feels best; a device of 1 kHz still draws it
  static constexpr double kDecay_s = 0.008;
  static constexpr double kEnd_s = 5 * kDecay_s;

  /// Of each answer. The first that is heard of, and a number that begins anew with another world, are no clicks.
  void hear(const hand::Clicks& clicks) noexcept {
    if (known_ && clicks.count > *known_) {
      strength_n_ = std::clamp(clicks.strength_n, 0.0, hand::kMaxClick_n);
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
    return strength_n_ * std::exp(-time_s_ / kDecay_s) * std::sin(2 * kPi * kFrequency_hz * time_s_) * Vec3::UnitY();
  }

 private:
  std::optional<std::uint32_t> known_;
  double strength_n_ = 0;
  double time_s_ = kEnd_s;
};

}  // namespace mechane::haptic
