#include "server/transport/haptic_publisher.hpp"

#include <chrono>
#include <future>

#include <pthread.h>
#include <sched.h>

#include "server/realtime/priority.hpp"
#include "server/transport/kiosk_link.hpp"

namespace mechane::transport {

HapticPublisher::HapticPublisher(int fifo_priority, std::optional<int> cpu) {
  std::promise<void> ready;
  thread_ = std::thread([this, fifo_priority, cpu, &ready] {
    pthread_setname_np(pthread_self(), "haptic-out");
    if (cpu) {
      cpu_set_t set;
      CPU_ZERO(&set);
      CPU_SET(static_cast<std::size_t>(*cpu), &set);
      pthread_setaffinity_np(pthread_self(), sizeof(set), &set);
    }
    fifo_granted_ = fifo_priority > 0 && realtime::take_fifo(fifo_priority);
    ready.set_value();
    while (!stop_.load(std::memory_order_acquire)) {
      wakeup_.wait(std::chrono::milliseconds(100));
      follow_changes();
      write_all();
    }
  });
  ready.get_future().wait();
}

HapticPublisher::~HapticPublisher() {
  stop_.store(true, std::memory_order_release);
  wakeup_.signal();
  thread_.join();
}

void HapticPublisher::add(const std::shared_ptr<Lane>& lane) {
  const std::lock_guard lock(mutex_);
  wanted_.push_back(lane);
  changes_.fetch_add(1, std::memory_order_release);
}

void HapticPublisher::remove(const std::shared_ptr<Lane>& lane) {
  {
    const std::lock_guard lock(mutex_);
    std::erase(wanted_, lane);
    changes_.fetch_add(1, std::memory_order_release);
  }
  wakeup_.signal();
}

void HapticPublisher::follow_changes() {
  if (changes_.load(std::memory_order_acquire) == changes_seen_) return;
  const std::lock_guard lock(mutex_);
  lanes_ = wanted_;
  changes_seen_ = changes_.load(std::memory_order_relaxed);
}

void HapticPublisher::write_all() noexcept {
  for (const auto& lane : lanes_) {
    const OutgoingForce* force = lane->forces.take();
    if (force == nullptr) continue;
    const TimePoint begin = std::chrono::steady_clock::now();
    if (!lane->link->write(*lane, *force)) failed_.fetch_add(1, std::memory_order_relaxed);
    write_time_.record(std::chrono::steady_clock::now() - begin);
  }
}

}  // namespace mechane::transport
