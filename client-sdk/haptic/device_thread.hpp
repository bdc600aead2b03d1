// DeviceThread: the thread of a haptic loop whose pace the device sets.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <thread>
#include <utility>

#include "client-sdk/haptic/driver_process.hpp"
#include "server/realtime/histogram.hpp"
#include "server/realtime/priority.hpp"

namespace mechane::haptic {

/// Owns one thread, from its making to stop(). It ticks with each state of the device; without one each 5 ms, so that times go on.
class DeviceThread {
 public:
  using Tick = std::function<void(TimePoint now, Duration dt)>;

  /// The tick must not throw. The device must be open, and outlive the thread.
  DeviceThread(DriverProcess& device, int fifo_priority, Tick tick)
      : thread_([this, &device, fifo_priority, run = std::move(tick)] {
          (void)realtime::take_fifo(fifo_priority);
          TimePoint before = newest_at();
          while (!stop_.load(std::memory_order_relaxed)) {
            const bool came = device.wait(kLongestWait);
            const TimePoint now = std::chrono::steady_clock::now();
            if (came)
              intervals_.record(now - newest_at_.exchange(now));
            else
              waits_.fetch_add(1, std::memory_order_relaxed);
            run(now, now - std::exchange(before, now));
          }
          // A device that was gone at the end has made its loop wait, too.
          if (before - newest_at() > kLongestWait) intervals_.record(before - newest_at());
        }) {}
  ~DeviceThread() { stop(); }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  void stop() noexcept {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// Between two states of the device. Any thread.
  [[nodiscard]] const realtime::LatencyHistogram& intervals() const noexcept { return intervals_; }
  /// When the loop was given the newest state; before the first one, when the thread was made. Any thread.
  [[nodiscard]] TimePoint newest_at() const noexcept { return newest_at_.load(); }
  /// Ticks without a state of the device. Any thread.
  [[nodiscard]] std::uint64_t without_state() const noexcept { return waits_.load(std::memory_order_relaxed); }

 private:
  static constexpr Duration kLongestWait = std::chrono::milliseconds(5);
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> waits_{0};
  std::atomic<TimePoint> newest_at_{std::chrono::steady_clock::now()};
  realtime::LatencyHistogram intervals_;
  std::thread thread_;  // last: it uses what stands above
};

/// How fast a device gives states, looked at ten times a second while its thread runs. One thread, any.
class DevicePace {
 public:
  struct Seen {
    double rate_hz = 0;  ///< states a second, over the last ten looks
    Duration longest{};  ///< without a state, since the last look; the wait for the next one counts, too
  };
  DevicePace(const DeviceThread& thread, TimePoint now) : thread_(thread) { looks_.fill({now, 0}); }

  [[nodiscard]] Seen look(TimePoint now) noexcept {
    const realtime::LatencyHistogram intervals = thread_.intervals();
    const Look newest{now, intervals.count()}, oldest = std::exchange(looks_[next_++ % looks_.size()], newest);
    const Duration longest =
        std::max(intervals.since(std::exchange(before_, intervals)).max(), now - thread_.newest_at());
    return {static_cast<double>(newest.states - oldest.states) / to_seconds(newest.at - oldest.at), longest};
  }

 private:
  struct Look {
    TimePoint at;
    std::uint64_t states = 0;
  };
  const DeviceThread& thread_;
  realtime::LatencyHistogram before_;
  std::array<Look, 10> looks_;
  std::size_t next_ = 0;
};

}  // namespace mechane::haptic
