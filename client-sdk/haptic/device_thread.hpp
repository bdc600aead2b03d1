// DeviceThread: the thread of a haptic loop whose pace the device sets.
#pragma once

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
          TimePoint before = std::chrono::steady_clock::now();
          while (!stop_.load(std::memory_order_relaxed)) {
            if (!device.wait(kLongestWait)) waits_.fetch_add(1, std::memory_order_relaxed);
            const TimePoint now = std::chrono::steady_clock::now();
            intervals_.record(now - before);
            run(now, now - std::exchange(before, now));
          }
        }) {}
  ~DeviceThread() { stop(); }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

  void stop() noexcept {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// Between two ticks. Any thread.
  [[nodiscard]] const realtime::LatencyHistogram& intervals() const noexcept { return intervals_; }
  /// Ticks without a state of the device. Any thread.
  [[nodiscard]] std::uint64_t without_state() const noexcept { return waits_.load(std::memory_order_relaxed); }

 private:
  static constexpr Duration kLongestWait = std::chrono::milliseconds(5);
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> waits_{0};
  realtime::LatencyHistogram intervals_;
  std::thread thread_;  // last: it uses what stands above
};

}  // namespace mechane::haptic
