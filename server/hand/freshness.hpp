// How old is what we know, and how much does it still count? Judged from the receiver's own clock and the last new
// sequence number, never from the sender's clock or from events of the transport.
#pragma once

#include <cstdint>

#include "server/base/clock.hpp"

namespace mechane::hand {

inline constexpr Duration kHoldFor = std::chrono::milliseconds(10);  ///< a sample counts in full up to this age
inline constexpr Duration kZeroBy = std::chrono::milliseconds(50);   ///< and not at all from this age on

/// The share of a force that a sample of this age still earns: 1 up to `hold`, exactly 0 from `zero_by` on, between
/// them the smooth step s^2 (3 - 2 s), which has no corner that a hand would feel. Falls, never rises, with age. `hold`
/// < `zero_by`.
[[nodiscard]] inline double freshness(Duration age, Duration hold = kHoldFor, Duration zero_by = kZeroBy) noexcept {
  if (age <= hold) return 1.0;
  if (age >= zero_by) return 0.0;
  const double s = static_cast<double>((zero_by - age).count()) / static_cast<double>((zero_by - hold).count());
  return s * s * (3.0 - 2.0 * s);
}

/// Follows the samples of one sender: which is new, and how long ago the last new one came. One thread; no allocation.
class SampleAge {
 public:
  /// Takes note of a sample that arrived at `now`. True when it is new: its sequence number is higher than any before
  /// it in its session, or its session is new. A repeated or older sequence is not new, and neither is a late sample of
  /// the session before.
  bool offer(std::uint64_t session, std::uint64_t sequence, TimePoint now) noexcept {
    if (known_ && session == session_) {
      if (sequence <= sequence_) return false;
    } else {
      if (known_ && had_session_before_ && session == session_before_) return false;
      had_session_before_ = known_;
      session_before_ = session_;
      session_ = session;
    }
    known_ = true;
    sequence_ = sequence;
    arrived_ = now;
    return true;
  }

  /// Time since the last new sample; Duration::max() when none ever came.
  [[nodiscard]] Duration age(TimePoint now) const noexcept {
    if (!known_) return Duration::max();
    return now > arrived_ ? now - arrived_ : Duration{0};
  }

  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] std::uint64_t session() const noexcept { return session_; }
  [[nodiscard]] std::uint64_t sequence() const noexcept { return sequence_; }

  /// Forgets everything, the last session too: the next sample is new whatever it says.
  void reset() noexcept { *this = SampleAge{}; }

 private:
  bool known_ = false;
  bool had_session_before_ = false;
  std::uint64_t session_ = 0;
  std::uint64_t session_before_ = 0;
  std::uint64_t sequence_ = 0;
  TimePoint arrived_{};
};

}  // namespace mechane::hand
