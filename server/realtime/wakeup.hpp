// Wakeup: many threads wake one. A loop signals it when there is something to fetch.
#pragma once

#include <atomic>
#include <cstdint>

#include "server/base/clock.hpp"

namespace mechane::realtime {

/// One futex word. signal() never waits, and makes a system call only while the waiter sleeps: at most one per sleep. Signals that
/// come before the waiter looks count as one: keep what there is to fetch in a mailbox or a ring.
class Wakeup {
 public:
  Wakeup() = default;
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;

  /// Any thread, the loop too. What was written before it is visible to the waiter after wait().
  void signal() noexcept;
  /// One thread. True when signalled since the last wait() returned; false when `timeout` has passed.
  bool wait(Duration timeout) noexcept;
  /// Whether wait() would return true at once: what a waiter that spins looks at. That thread.
  [[nodiscard]] bool signalled() const noexcept { return word_.load(std::memory_order_relaxed) == kSignalled; }

 private:
  static constexpr std::uint32_t kIdle = 0;
  static constexpr std::uint32_t kSignalled = 1;
  static constexpr std::uint32_t kAsleep = 2;
  std::atomic<std::uint32_t> word_{kIdle};
};

}  // namespace mechane::realtime
