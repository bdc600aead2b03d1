// How old the newest sample of a hand is, and how much it still counts. Judged from the receiver's own clock and the last new
// sequence number, never from the sender's clock or from events of the transport.
#pragma once

#include <algorithm>
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

/// What a client renders by itself is gone this long after its validity.
inline constexpr Duration kFadeTime = std::chrono::milliseconds(20);

/// The share of what a client renders by itself: 1 while it is valid, then linearly to exactly 0.
[[nodiscard]] inline double share_left(Duration age, Duration validity) noexcept {
  if (age <= validity) return 1.0;
  return std::max(0.0, 1.0 - to_seconds(age - validity) / to_seconds(kFadeTime));
}

/// How a sample's sequence number stands to those before it.
enum class SampleOrder : std::uint8_t {
  newer,     ///< to be used
  older,     ///< repeated, overtaken on the way, or of the session before
  too_high,  ///< no sender counts that fast: a broken or a false sample
};

/// Follows the samples of one sender: which is new, and how long ago the last new one came. One thread; no allocation.
///
/// One wrong sequence number must not block the hand for good. So a number that is too high is not taken. A session's first number cannot
/// be compared with anything; if it was wrong, every later one is refused. After kPatience of that, refused samples that count upwards in
/// step with each other are taken as the sender's (as RFC 3550, appendix A.1, does after two; we ask for more).
class SampleAge {
 public:
  static constexpr std::uint64_t kMostPerMillisecond = 10;  ///< no device is faster
  static constexpr std::uint64_t kSlack = 100;              ///< samples: what a delayed burst may be ahead of its time
  static constexpr Duration kPatience = std::chrono::milliseconds(500);
  static constexpr int kInStep = 10;  ///< refused samples

  /// Takes note of a sample that arrived at `now`.
  SampleOrder offer(std::uint64_t session, std::uint64_t sequence, TimePoint now) noexcept {
    if (!known_ || session != session_) {
      if (known_ && had_session_before_ && session == session_before_) return SampleOrder::older;
      had_session_before_ = known_;
      session_before_ = session_;
      session_ = session;
      return take(sequence, now);
    }
    if (sequence > last_.sequence && last_.may_precede(sequence, now)) return take(sequence, now);
    if (counts_in_step(sequence, now) && now - last_.arrived >= kPatience) return take(sequence, now);
    return sequence > last_.sequence ? SampleOrder::too_high : SampleOrder::older;
  }

  /// Time since the last new sample; Duration::max() when none ever came.
  [[nodiscard]] Duration age(TimePoint now) const noexcept {
    if (!known_) return Duration::max();
    return now > last_.arrived ? now - last_.arrived : Duration{0};
  }

  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] std::uint64_t session() const noexcept { return session_; }
  [[nodiscard]] std::uint64_t sequence() const noexcept { return last_.sequence; }

  /// Forgets everything, the last session too: the next sample is new whatever its number.
  void reset() noexcept { *this = SampleAge{}; }

 private:
  struct Mark {
    std::uint64_t sequence = 0;
    TimePoint arrived{};
    /// Whether a sender can have counted from here to `later` (which is higher) by `now`.
    [[nodiscard]] bool may_precede(std::uint64_t later, TimePoint now) const noexcept {
      const auto passed = std::chrono::duration_cast<std::chrono::milliseconds>(now - arrived).count();
      const std::uint64_t since_ms = passed > 0 ? static_cast<std::uint64_t>(passed) : 0;
      return later - sequence <= kSlack + kMostPerMillisecond * since_ms;
    }
  };

  SampleOrder take(std::uint64_t sequence, TimePoint now) noexcept {
    known_ = true;
    last_ = {sequence, now};
    in_step_ = 0;
    return SampleOrder::newer;
  }

  /// Follows one series of refused samples; another one is followed when that has ended.
  bool counts_in_step(std::uint64_t sequence, TimePoint now) noexcept {
    const bool follows = in_step_ > 0 && sequence > refused_.sequence && refused_.may_precede(sequence, now);
    if (!follows && in_step_ > 0 && now - refused_.arrived < kPatience) return false;
    in_step_ = follows ? in_step_ + 1 : 1;
    refused_ = {sequence, now};
    return in_step_ >= kInStep;
  }

  bool known_ = false;
  bool had_session_before_ = false;
  std::uint64_t session_ = 0;
  std::uint64_t session_before_ = 0;
  Mark last_;     // the newest that was taken
  Mark refused_;  // the newest of those refused that count in step
  int in_step_ = 0;
};

}  // namespace mechane::hand
