// HeatLimit: a device bears its largest force for a moment, and a smaller one all day.
#pragma once

#include <algorithm>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"

namespace mechane::haptic {

/// A motor's heat grows with the square of its force. When the mean square of the last 20 s is over that of the continuous force, the
/// limit falls slowly towards the continuous force, a thousandth each millisecond; it rises again in the same way when the mean has
/// fallen under 80 % of it. The times are ours: makers do not publish theirs. The loop's thread; no allocation.
class HeatLimit {
 public:
  HeatLimit(double peak_n, double continuous_n) : peak_n_(peak_n), continuous_n_(continuous_n), limit_n_(peak_n) {}

  /// Shortens the force to what the motors bear now. True when it was longer. What is not finite is left alone.
  [[nodiscard]] bool limit(Vec3& force) const noexcept {
    const double norm = force.stableNorm();
    if (!(norm > limit_n_) || limit_n_ >= peak_n_) return false;
    force *= limit_n_ / norm;
    return true;
  }
  /// Whether the largest force is not allowed now.
  [[nodiscard]] bool lowered() const noexcept { return limit_n_ < peak_n_; }
  /// The force that acted for `dt`, N.
  void rendered(double force_n, Duration dt) noexcept {
    const double dt_s = std::clamp(to_seconds(dt), 0.0, kMean_s);
    mean_square_n2_ += (force_n * force_n - mean_square_n2_) * dt_s / kMean_s;
    const double step = std::min(dt_s, 0.01);  // 1 / s: a thousandth in a millisecond
    if (mean_square_n2_ > continuous_n_ * continuous_n_)
      limit_n_ = std::max(limit_n_ * (1 - step), continuous_n_);
    else if (mean_square_n2_ < kCool * kCool * continuous_n_ * continuous_n_)
      limit_n_ = std::min(limit_n_ * (1 + step), peak_n_);
  }

 private:
  static constexpr double kMean_s = 20;
  static constexpr double kCool = 0.8;
  double peak_n_;
  double continuous_n_;
  double limit_n_;
  double mean_square_n2_ = 0;
};

}  // namespace mechane::haptic
