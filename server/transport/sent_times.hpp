// When a link sent its last outputs, from which the delay of its network is measured.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "server/base/clock.hpp"

namespace mechane::transport {

/// note() is for the thread that writes outputs, round_trip_of() for the one that listens to samples. Wait-free.
class SentTimes {
 public:
  /// When a sender has had no output for longer, its echo says nothing about the network.
  static constexpr Duration kForgets = std::chrono::seconds(1);

  /// The output with this sequence number is about to be sent; numbers rise by one, from 1 on.
  void note(std::uint64_t sequence, TimePoint now) noexcept {
    sent_ns_[sequence % sent_ns_.size()].store(now.time_since_epoch().count(), std::memory_order_relaxed);
    newest_.store(sequence, std::memory_order_release);
  }

  /// The round trip of a sample that arrived `now`: output `echo` went to its sender, who had it for `held` and then sent the sample. When
  /// the output is too old for the table, returns the shortest time that it can have been. Returns zero when nothing is known (`echo` is 0,
  /// or `held` is over kForgets), and nothing when the output was never sent.
  [[nodiscard]] std::optional<Duration> round_trip_of(std::uint64_t echo, Duration held, TimePoint now) const noexcept {
    const std::uint64_t newest = newest_.load(std::memory_order_acquire);
    if (echo > newest) return std::nullopt;
    if (echo == 0 || held > kForgets) return Duration{0};
    const std::uint64_t kept = std::min(newest, sent_ns_.size() / 2);  // the other half may be written meanwhile
    const std::uint64_t known = std::max(echo, newest - kept + 1);
    const std::int64_t sent_ns = sent_ns_[known % sent_ns_.size()].load(std::memory_order_relaxed);
    return std::max(now.time_since_epoch() - Duration(sent_ns) - held, Duration{0});
  }

 private:
  std::array<std::atomic<std::int64_t>, 2048> sent_ns_{};
  std::atomic<std::uint64_t> newest_{0};
};

}  // namespace mechane::transport
