// PeriodicThread: one thread that wakes on a fixed grid of times, and that counts its own faults apart from those of the machine.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/realtime/histogram.hpp"

namespace mechane::realtime {

struct PeriodicConfig {
  std::string name = "periodic";  ///< as `top -H` shows it; the first 15 bytes count
  Duration period = kTickPeriod;  ///< over 0
  int fifo_priority = 0;          ///< SCHED_FIFO 1 .. 99; 0: an ordinary thread
  std::optional<int> cpu;         ///< pins the thread to this processor
  bool lock_memory = false;       ///< mlockall for the whole process: no page fault waits for a disk
  Duration late_after = std::chrono::microseconds(100);  ///< a wake-up later than this is counted
};

/// What a tick is told about time.
struct TickTiming {
  std::uint64_t index = 0;    ///< ticks run before this one
  TimePoint due;              ///< the grid point that this tick stands for
  TimePoint woke;             ///< when it began
  std::uint64_t skipped = 0;  ///< grid points left out between the last tick and this one
};

/// Counted apart, never hidden. `overruns` are ours; `late_wakeups` and `preemptions` are the machine's.
struct PeriodicReport {
  std::uint64_t ticks = 0;
  std::uint64_t overruns = 0;  ///< ticks whose own CPU time was over the period
  std::uint64_t preemptions =
      0;  ///< ticks that took longer than the period on the wall clock while their CPU time did not
  std::uint64_t late_wakeups = 0;  ///< slept, and woke more than `late_after` past the due time
  std::uint64_t skipped = 0;       ///< grid points left out because the time for them had passed
  bool running = false;
  bool fifo_granted = false;   ///< SCHED_FIFO was asked for and granted
  bool cpu_granted = false;    ///< pinning was asked for and done
  bool memory_locked = false;  ///< locking was asked for and done
};

/// Owns one thread, from start() to stop(). The grid is `start + n * period`. A tick that ends after the next grid
/// point is followed at once by the next tick; one that ends a whole period or more after it is followed by the first
/// grid point in the future: a loop that was stalled goes on in step, and never runs a burst to catch up.
class PeriodicThread {
 public:
  /// Called in the loop; must not throw. It may call request_stop().
  using Tick = std::function<void(const TickTiming&)>;

  /// The clock must outlive this object. After start(), only the thread calls it.
  PeriodicThread(PeriodicConfig config, Clock& clock);
  /// Stops and joins.
  ~PeriodicThread();
  PeriodicThread(const PeriodicThread&) = delete;
  PeriodicThread& operator=(const PeriodicThread&) = delete;

  /// Starts the thread; returns when its priority, processor and memory are set, so that report() tells what was
  /// granted. Rights that are refused are not errors: the loop runs without. Errors: a bad configuration, a thread that
  /// cannot be made, started twice.
  [[nodiscard]] Expected<void> start(Tick tick);

  /// Any thread, and the tick itself: no tick begins after the one that runs now.
  void request_stop() noexcept;
  /// Requests a stop and joins: within a period, or 20 ms where the period is longer, after the tick that runs now. Not
  /// from the tick.
  void stop() noexcept;

  /// Any thread, at any time, without a lock.
  [[nodiscard]] PeriodicReport report() const noexcept;
  [[nodiscard]] const LatencyHistogram& wake_latency() const noexcept {
    return wake_latency_;
  }                                                                                      ///< woke - due, where it slept
  [[nodiscard]] const LatencyHistogram& cpu_time() const noexcept { return cpu_time_; }  ///< a tick's own CPU time
  [[nodiscard]] const LatencyHistogram& wall_time() const noexcept { return wall_time_; }  ///< a tick on the wall clock
  [[nodiscard]] const PeriodicConfig& config() const noexcept { return config_; }

 private:
  using Counter = std::atomic<std::uint64_t>;

  void prepare() noexcept;
  void run(const Tick& tick) noexcept;
  /// Waits for `due`, in slices that keep a stop prompt. False when it was due already.
  bool sleep_until(TimePoint due) noexcept;
  void run_tick(const Tick& tick, const TickTiming& timing) noexcept;
  [[nodiscard]] TickTiming next_after(const TickTiming& last) noexcept;

  PeriodicConfig config_;
  Clock& clock_;
  std::thread thread_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> running_{false};
  std::atomic<bool> fifo_granted_{false};
  std::atomic<bool> cpu_granted_{false};
  std::atomic<bool> memory_locked_{false};
  Counter ticks_{0};
  Counter overruns_{0};
  Counter preemptions_{0};
  Counter late_wakeups_{0};
  Counter skipped_{0};
  LatencyHistogram wake_latency_;
  LatencyHistogram cpu_time_;
  LatencyHistogram wall_time_;
};

}  // namespace mechane::realtime
