// Ring: a bounded queue from one thread to one other thread. Wait-free; a full ring refuses, and its producer counts
// the loss.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "server/base/assert.hpp"

namespace mechane::realtime {

/// For exactly one producer thread and one consumer thread. All slots are made at construction; no call after it
/// allocates, provided that T's copy assignment does not.
///
/// `head_` counts all values ever pushed, `tail_` all ever popped (64 bits: they do not wrap in a museum's life). A
/// slot is written before the release store of head_ and read after the acquire load of it; it is read before the
/// release store of tail_ and written again only after the acquire load of it. Each side keeps its last view of the
/// other's counter, so that it touches the other's cache line only when the ring looks full or empty.
template <class T>
class Ring {
 public:
  /// `capacity` is a power of two.
  explicit Ring(std::size_t capacity) : slots_(capacity), mask_(capacity - 1) {
    MECHANE_ASSERT(capacity > 0 && (capacity & mask_) == 0);
  }
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  [[nodiscard]] std::size_t capacity() const noexcept { return slots_.size(); }

  /// Producer: false when the ring is full; `value` is then lost, unless the caller keeps it.
  [[nodiscard]] bool push(const T& value) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_seen_ == slots_.size()) {
      tail_seen_ = tail_.load(std::memory_order_acquire);
      if (head - tail_seen_ == slots_.size()) return false;
    }
    slots_[head & mask_] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  /// Consumer: the oldest value, still in the ring; null when it is empty. Good until pop().
  [[nodiscard]] const T* front() noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (head_seen_ == tail) {
      head_seen_ = head_.load(std::memory_order_acquire);
      if (head_seen_ == tail) return nullptr;
    }
    return &slots_[tail & mask_];
  }
  /// Consumer: gives the slot of front() back. Only after front() was not null.
  void pop() noexcept { tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
  /// Consumer: copies the oldest value out and pops it.
  [[nodiscard]] bool pop(T& out) noexcept {
    const T* value = front();
    if (value == nullptr) return false;
    out = *value;
    pop();
    return true;
  }

 private:
  std::vector<T> slots_;
  std::size_t mask_;
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;  // the producer's
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t head_seen_ = 0;  // the consumer's
};

}  // namespace mechane::realtime
