// Checks samples and statuses from the network, before anything else sees them. The loop relies on it and does not check again.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>

#include "server/state/input.hpp"
#include "server/transport/session_table.hpp"
#include <mechane/proto/topics.hpp>

namespace mechane::transport {

inline constexpr double kMaxSpeedMPerS = 50;
inline constexpr double kMaxTurnRadPerS = 200;
inline constexpr double kMaxJointRad = 7;

/// Why a sample is dropped.
enum class Reject : std::uint8_t {
  none = 0,
  wrong_protocol,  ///< another version of the wire
  not_finite,
  bad_rotation,   ///< not of unit length within 1 %
  too_far,        ///< |p| over 100 m
  too_fast,       ///< over 50 m/s or 200 rad/s
  bad_size,       ///< hand_scale not 0.5 .. 1.5, or one of finger_scale not 0.7 .. 1.4
  bad_value,      ///< a joint over 7 rad, intent out of 0 .. 1, an unknown kind, side or user
  wrong_kiosk,    ///< the sample names another kiosk than its partition does
  wrong_session,  ///< 0, or a session that does not own this hand
  old_sequence,   ///< repeated or older
  high_sequence,  ///< higher than any device can have counted since its last sample
  too_late,       ///< its round trip was too long: what it shows of the hand is past
  kinds
};

[[nodiscard]] std::string_view to_string(Reject reason);

/// Where the sample is fit for the loop, fills `out`, with the rotation scaled to unit length, and returns Reject::none. Does not check
/// who owns the hand, nor sequence numbers. Allocates nothing.
[[nodiscard]] Reject validate(const proto::HapticInput& sample, hand::SentSample& out) noexcept;

/// Where a client's version, names, user, role and session are valid, fills `out` and returns Reject::none. Control characters in texts are
/// replaced.
[[nodiscard]] Reject validate(const proto::KioskStatus& status, Session& out);

/// Counts per reason. Any thread.
class RejectCounters {
 public:
  void add(Reject reason) noexcept {
    if (reason != Reject::none) counts_[static_cast<std::size_t>(reason)].fetch_add(1, std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t count(Reject reason) const noexcept {
    return counts_[static_cast<std::size_t>(reason)].load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t total() const noexcept;

 private:
  std::array<std::atomic<std::uint64_t>, static_cast<std::size_t>(Reject::kinds)> counts_{};
};

/// Turns counters into at most one line for each call: "rejected 12 samples: 10 not finite, 2 of another protocol version". Empty when
/// nothing was rejected since the last call. One thread.
class RejectReport {
 public:
  [[nodiscard]] std::string since_last(const RejectCounters& counters);

 private:
  std::array<std::uint64_t, static_cast<std::size_t>(Reject::kinds)> seen_{};
};

}  // namespace mechane::transport
