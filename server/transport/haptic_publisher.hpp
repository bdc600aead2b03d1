// HapticPublisher: the thread that writes HapticOutput and nothing else, so that no reliable write ever delays a force.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/realtime/histogram.hpp"
#include "server/realtime/wakeup.hpp"
#include "server/transport/hand_channel.hpp"

namespace mechane::transport {

/// Owns one thread, SCHED_FIFO where that is granted. add() and remove() are for the main thread. A loop calls expect_forces() at the
/// beginning of a tick with a fresh sample, and forces_are_ready() when the forces are in the channels. The thread wakes while the tick
/// computes and spins until its end, so that no force waits for a wake-up (about 50 us on our machines).
class HapticPublisher {
 public:
  HapticPublisher(int fifo_priority, std::optional<int> cpu);
  ~HapticPublisher();
  HapticPublisher(const HapticPublisher&) = delete;
  HapticPublisher& operator=(const HapticPublisher&) = delete;

  void expect_forces() noexcept;
  void forces_are_ready() noexcept { wakeup_.signal(); }
  void add(const std::shared_ptr<HandChannel>& channel);
  void remove(const std::shared_ptr<HandChannel>& channel);

  [[nodiscard]] bool fifo_granted() const { return fifo_granted_.load(); }
  [[nodiscard]] const realtime::LatencyHistogram& write_time() const { return write_time_; }
  /// How often a hand that was sending paused for longer than its force is held (10 ms) and sent again within 100 ms.
  [[nodiscard]] std::uint64_t input_gaps() const { return input_gaps_.load(std::memory_order_relaxed); }
  /// The longest of these pauses since the last call. For one other thread.
  [[nodiscard]] Duration take_longest_gap() { return Duration(longest_gap_ns_.exchange(0, std::memory_order_relaxed)); }
  [[nodiscard]] std::uint64_t writes_failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  void follow_changes();
  void await_forces() noexcept;
  bool write_all() noexcept;
  void note_age(HandChannel& channel, Duration age) noexcept;

  realtime::Wakeup wakeup_;
  std::mutex mutex_;  // for wanted_; the thread takes it only when the list has changed
  std::vector<std::shared_ptr<HandChannel>> wanted_;
  std::atomic<std::uint64_t> changes_{0};
  std::atomic<int> loop_cpu_{-1};  // where the last tick began
  std::atomic<bool> stop_{false};
  std::atomic<bool> fifo_granted_{false};
  std::atomic<std::uint64_t> failed_{0};
  std::atomic<std::uint64_t> input_gaps_{0};
  std::atomic<std::int64_t> longest_gap_ns_{0};
  realtime::LatencyHistogram write_time_;
  std::vector<std::shared_ptr<HandChannel>> channels_;  // for the thread only
  std::uint64_t changes_seen_ = 0;                      // for the thread only
  std::thread thread_;
};

}  // namespace mechane::transport
