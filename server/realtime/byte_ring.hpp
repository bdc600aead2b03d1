// ByteRing: a bounded queue of records of different lengths, from one thread to one other thread. It carries a journal's bytes.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "server/base/assert.hpp"

namespace mechane::realtime {

/// For exactly one producer thread and one consumer thread; wait-free, no allocation after construction. Memory orders
/// as in Ring: bytes are published by the release store of head_ and given back by the release store of tail_. A record
/// lies in one piece: where it does not fit before the end of the buffer, a length of kSkip says that it starts at the
/// beginning.
class ByteRing {
 public:
  /// `capacity` in bytes is a power of two, at least 64. A record takes its own length, 4 bytes more, rounded up to 4.
  explicit ByteRing(std::size_t capacity) : bytes_(capacity), mask_(capacity - 1) {
    MECHANE_ASSERT(capacity >= 64 && (capacity & mask_) == 0);
  }
  ByteRing(const ByteRing&) = delete;
  ByteRing& operator=(const ByteRing&) = delete;

  [[nodiscard]] std::size_t capacity() const noexcept { return bytes_.size(); }

  /// Producer: false when there is no room. Records over a quarter of the capacity are always refused.
  [[nodiscard]] bool push(std::span<const std::byte> record) noexcept {
    const std::size_t need = kPrefix + rounded(record.size());
    if (need > bytes_.size() / 4) return false;
    std::size_t head = head_.load(std::memory_order_relaxed);
    const std::size_t to_end = bytes_.size() - (head & mask_);
    const std::size_t skip = to_end < need ? to_end : 0;
    if (!has_room(head, skip + need)) return false;
    if (skip > 0) {
      put_length(head, kSkip);
      head += skip;
    }
    put_length(head, static_cast<std::uint32_t>(record.size()));
    if (!record.empty()) std::memcpy(&bytes_[(head & mask_) + kPrefix], record.data(), record.size());
    head_.store(head + need, std::memory_order_release);
    return true;
  }

  /// Consumer: the oldest record, in place; `found` is false when the ring is empty. Good until pop().
  struct Front {
    bool found = false;
    std::span<const std::byte> record;
  };
  [[nodiscard]] Front front() noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (head_seen_ == tail) {
      head_seen_ = head_.load(std::memory_order_acquire);
      if (head_seen_ == tail) return {};
    }
    start_ = tail;
    std::uint32_t length = length_at(start_);
    if (length == kSkip) {
      start_ += bytes_.size() - (start_ & mask_);
      length = length_at(start_);
    }
    return {true, {&bytes_[(start_ & mask_)] + kPrefix, length}};
  }
  /// Consumer: gives the bytes of front() back. Only after front() found a record.
  void pop() noexcept { tail_.store(start_ + kPrefix + rounded(length_at(start_)), std::memory_order_release); }

 private:
  static constexpr std::size_t kPrefix = 4;
  static constexpr std::uint32_t kSkip = 0xffffffffu;

  static std::size_t rounded(std::size_t length) noexcept { return (length + 3) & ~std::size_t{3}; }
  bool has_room(std::size_t head, std::size_t need) noexcept {
    if (bytes_.size() - (head - tail_seen_) >= need) return true;
    tail_seen_ = tail_.load(std::memory_order_acquire);
    return bytes_.size() - (head - tail_seen_) >= need;
  }
  void put_length(std::size_t at, std::uint32_t length) noexcept { std::memcpy(&bytes_[at & mask_], &length, kPrefix); }
  [[nodiscard]] std::uint32_t length_at(std::size_t at) const noexcept {
    std::uint32_t length = 0;
    std::memcpy(&length, &bytes_[at & mask_], kPrefix);
    return length;
  }

  std::vector<std::byte> bytes_;
  std::size_t mask_;
  alignas(64) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;  // the producer's
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::size_t head_seen_ = 0;  // the consumer's
  std::size_t start_ = 0;      // the consumer's: where the record of front() begins
};

}  // namespace mechane::realtime
