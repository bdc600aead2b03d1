// HapticPublisher: the thread that writes HapticOutput and nothing else, so that no reliable write ever holds a force back.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "server/realtime/histogram.hpp"
#include "server/realtime/wakeup.hpp"
#include "server/transport/lane.hpp"

namespace mechane::transport {

/// Owns one thread, SCHED_FIFO where that is granted. add() and remove() are the main thread's. A loop calls expect_forces() when a
/// tick begins that answers a hand, and forces_are_ready() when it has filled the lanes: the thread wakes while the tick computes and
/// spins for its end, which saves every force a wake-up (about 50 us on the machines seen here).
class HapticPublisher {
 public:
  HapticPublisher(int fifo_priority, std::optional<int> cpu);
  ~HapticPublisher();
  HapticPublisher(const HapticPublisher&) = delete;
  HapticPublisher& operator=(const HapticPublisher&) = delete;

  void expect_forces() noexcept;
  void forces_are_ready() noexcept { wakeup_.signal(); }
  void add(const std::shared_ptr<Lane>& lane);
  void remove(const std::shared_ptr<Lane>& lane);

  [[nodiscard]] bool fifo_granted() const { return fifo_granted_.load(); }
  [[nodiscard]] const realtime::LatencyHistogram& write_time() const { return write_time_; }
  /// Times that a hand which was sending paused for longer than its force holds (10 ms) and sent again within 100 ms.
  [[nodiscard]] std::uint64_t input_gaps() const { return input_gaps_.load(std::memory_order_relaxed); }
  /// The longest of them since the last call. One other thread.
  [[nodiscard]] Duration take_longest_gap() { return Duration(longest_gap_ns_.exchange(0, std::memory_order_relaxed)); }
  [[nodiscard]] std::uint64_t writes_failed() const { return failed_.load(std::memory_order_relaxed); }

 private:
  void follow_changes();
  void await_forces() noexcept;
  bool write_all() noexcept;
  void note_age(Lane& lane, Duration age) noexcept;

  realtime::Wakeup wakeup_;
  std::mutex mutex_;  // for wanted_; the thread takes it only when the list has changed
  std::vector<std::shared_ptr<Lane>> wanted_;
  std::atomic<std::uint64_t> changes_{0};
  std::atomic<int> loop_cpu_{-1};  // where the last tick began
  std::atomic<bool> stop_{false};
  std::atomic<bool> fifo_granted_{false};
  std::atomic<std::uint64_t> failed_{0};
  std::atomic<std::uint64_t> input_gaps_{0};
  std::atomic<std::int64_t> longest_gap_ns_{0};
  realtime::LatencyHistogram write_time_;
  std::vector<std::shared_ptr<Lane>> lanes_;  // the thread's
  std::uint64_t changes_seen_ = 0;            // the thread's
  std::thread thread_;
};

}  // namespace mechane::transport
