#include "server/transport/haptic_publisher.hpp"

#include <chrono>
#include <future>
#include <utility>

#include <sched.h>

#include "server/base/thread_setup.hpp"
#include "server/realtime/priority.hpp"
#include "server/transport/kiosk_link.hpp"

namespace mechane::transport {
namespace {

// Longer than a tick should take. For the forces of a longer tick the thread sleeps.
constexpr Duration kLongestSpin = std::chrono::microseconds(200);
// A longer pause may be intended: a pointer sends nothing between two taps.
constexpr Duration kLongestGap = std::chrono::milliseconds(100);

}  // namespace

HapticPublisher::HapticPublisher(int fifo_priority, std::optional<int> cpu) {
  std::promise<void> ready;
  thread_ = std::thread([this, fifo_priority, cpu, &ready] {
    set_up_thread("haptic-out");
    if (cpu) (void)realtime::pin_to(*cpu);
    fifo_granted_ = fifo_priority > 0 && realtime::take_fifo(fifo_priority);
    ready.set_value();
    while (!stop_.load(std::memory_order_acquire)) {
      const bool called = wakeup_.wait(std::chrono::milliseconds(100));
      follow_changes();
      if (!write_all() && called) await_forces();
    }
  });
  ready.get_future().wait();
}

HapticPublisher::~HapticPublisher() {
  stop_.store(true, std::memory_order_release);
  wakeup_.signal();
  thread_.join();
}

void HapticPublisher::add(const std::shared_ptr<HandChannel>& channel) {
  const std::lock_guard lock(mutex_);
  wanted_.push_back(channel);
  changes_.fetch_add(1, std::memory_order_release);
}

void HapticPublisher::remove(const std::shared_ptr<HandChannel>& channel) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(wanted_, channel);
    changes_.fetch_add(1, std::memory_order_release);
  }
  wakeup_.signal();
}

void HapticPublisher::follow_changes() {
  if (changes_.load(std::memory_order_acquire) == changes_seen_) return;
  const std::lock_guard lock(mutex_);
  channels_ = wanted_;
  changes_seen_ = changes_.load(std::memory_order_relaxed);
}

void HapticPublisher::expect_forces() noexcept {
  loop_cpu_.store(sched_getcpu(), std::memory_order_relaxed);
  wakeup_.signal();
}

void HapticPublisher::await_forces() noexcept {
  const TimePoint until = std::chrono::steady_clock::now() + kLongestSpin;
  while (!wakeup_.signalled() && std::chrono::steady_clock::now() < until) {
    if (sched_getcpu() == loop_cpu_.load(std::memory_order_relaxed)) return;  // the tick needs this processor
  }
}

void HapticPublisher::note_age(HandChannel& channel, Duration age) noexcept {
  const Duration before = std::exchange(channel.input_age, age);
  if (age >= before || before <= hand::kHoldFor || before > kLongestGap) return;
  input_gaps_.fetch_add(1, std::memory_order_relaxed);
  std::int64_t longest = longest_gap_ns_.load(std::memory_order_relaxed);
  while (longest < before.count() && !longest_gap_ns_.compare_exchange_weak(longest, before.count())) {
  }
}

bool HapticPublisher::write_all() noexcept {
  bool any = false;
  for (const auto& channel : channels_) {
    const OutgoingForce* force = channel->forces.take();
    if (force == nullptr) continue;
    any = true;
    note_age(*channel, force->waited);
    const TimePoint begin = std::chrono::steady_clock::now();
    const double share = channel->deadband_share.load(std::memory_order_relaxed);
    if (!channel->deadband.is_due(share, force->output, force->p_WH, begin)) continue;
    if (!channel->link->write(*channel, *force)) {
      failed_.fetch_add(1, std::memory_order_relaxed);
    } else if (share > 0) {
      channel->deadband.note_sent(force->output, force->p_WH, begin);
    }
    write_time_.record(std::chrono::steady_clock::now() - begin);
  }
  return any;
}

}  // namespace mechane::transport
