// Time. A Duration is not a double: std::chrono keeps them apart. Loops take their clock from outside, so that tests can turn it.
#pragma once

#include <chrono>
#include <cstdint>

namespace mechane {

using Duration = std::chrono::nanoseconds;
/// Monotonic time. On the wire and in records it is nanoseconds since an origin of the sender's own.
using TimePoint = std::chrono::time_point<std::chrono::steady_clock, Duration>;

inline constexpr Duration kTickPeriod = std::chrono::milliseconds(1);
inline constexpr double kTickSeconds = 1e-3;

/// A clock that a loop waits on. Called from the loop's own thread only; no call allocates, locks or throws.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual TimePoint now() noexcept = 0;
  /// Returns at `wake` or later.
  virtual void sleep_until(TimePoint wake) noexcept = 0;
  /// CPU time that the calling thread has used: shows whether an overrun is our own work or a stall of the machine.
  [[nodiscard]] virtual Duration thread_cpu_time() noexcept = 0;
};

/// CLOCK_MONOTONIC with absolute waits (clock_nanosleep), and CLOCK_THREAD_CPUTIME_ID.
class SystemClock final : public Clock {
 public:
  [[nodiscard]] TimePoint now() noexcept override;
  void sleep_until(TimePoint wake) noexcept override;
  [[nodiscard]] Duration thread_cpu_time() noexcept override;
};

[[nodiscard]] inline double to_seconds(Duration d) {
  return std::chrono::duration<double>(d).count();
}

[[nodiscard]] inline double to_us(Duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

/// The date, in ns since 1970: for names and records, not for measuring how long something took.
[[nodiscard]] inline std::uint64_t wall_now_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

[[nodiscard]] inline std::uint64_t to_ns(TimePoint t) {
  return static_cast<std::uint64_t>(t.time_since_epoch().count());
}

}  // namespace mechane
