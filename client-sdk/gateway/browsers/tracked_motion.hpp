// From what a headset sees, up to 90 times a second, to a hand that moves evenly at the rate of the world. Pure.
#pragma once

#include <optional>

#include "client-sdk/drivers/joints/hand_measure.hpp"
#include "client-sdk/gateway/browsers/tracked_message.hpp"
#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::gateway {

/// A tracker overlooks a hand for some pictures now and then, a wireless network loses some, and a page that the processor draws is late.
/// A hand that is gone for longer lets go. No device presses on the visitor's hand meanwhile.
inline constexpr Duration kHandOverlooked = std::chrono::milliseconds(500);

/// One hand of one visitor. The hand goes from where it was shown to what was seen last within the time between two pictures, so it is
/// late by that time and never goes beyond what was seen. One thread; allocates nothing.
class TrackedMotion {
 public:
  /// A picture of the hand, at `now`. A hand that is not tracked, and points that are not those of a hand, change nothing.
  void take(const TrackedHand& seen, TimePoint now) noexcept;
  /// The sample to send now; none: the hand is not there, or has not been seen for kHandOverlooked.
  [[nodiscard]] std::optional<client::HandSample> at(TimePoint now) noexcept;
  /// The hand was seen this long ago at most.
  [[nodiscard]] bool is_seen(TimePoint now) const noexcept { return newest_ && now - seen_at_ <= kHandOverlooked; }
  void forget() noexcept;

 private:
  [[nodiscard]] std::optional<client::HandSample> sample_of(const TrackedHand& seen) noexcept;
  [[nodiscard]] client::HandSample between(double share) const noexcept;

  std::optional<client::HandSample> from_, newest_;
  TimePoint seen_at_;
  Duration step_{0};  ///< from from_ to newest_
  drivers::HandMeasure measure_;
};

}  // namespace mechane::gateway
