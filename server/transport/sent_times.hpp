// When a link sent its last outputs: how long a sample has been on its way can be told from the output that its sender had.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

#include "server/base/clock.hpp"

namespace mechane::transport {

/// note() is for the thread that writes outputs, age_of() for the one that listens to samples. Wait-free.
class SentTimes {
 public:
  /// The output with this sequence number is about to be sent; numbers rise by one, from 1 on.
  void note(std::uint64_t sequence, TimePoint now) noexcept {
    sent_ns_[sequence % sent_ns_.size()].store(now.time_since_epoch().count(), std::memory_order_relaxed);
    newest_.store(sequence, std::memory_order_release);
  }

  /// The most that a sample can have been on its way here, with the way of an output there: the time since the first output that its sender
  /// had not seen. `echo` is the newest that it had; 0: none, and nothing is known. None where that was never sent.
  [[nodiscard]] std::optional<Duration> age_of(std::uint64_t echo, TimePoint now) const noexcept {
    const std::uint64_t newest = newest_.load(std::memory_order_acquire);
    if (echo > newest) return std::nullopt;
    if (echo == 0 || echo == newest) return Duration{0};
    if (newest - echo >= sent_ns_.size() / 2) return Duration::max();  // the other half may be written meanwhile
    const std::int64_t sent_ns = sent_ns_[(echo + 1) % sent_ns_.size()].load(std::memory_order_relaxed);
    return now.time_since_epoch() - Duration(sent_ns);
  }

 private:
  std::array<std::atomic<std::int64_t>, 2048> sent_ns_{};
  std::atomic<std::uint64_t> newest_{0};
};

}  // namespace mechane::transport
