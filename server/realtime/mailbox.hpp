// Mailbox: the newest value of one thread for one other thread. Wait-free on both sides; older values are overwritten,
// never queued.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace mechane::realtime {

/// A triple buffer for exactly one producer thread and one consumer thread. Neither call waits, locks or allocates,
/// provided that T's copy assignment does not (a trivially copyable T, or one whose buffers were reserved by the slot
/// factory).
///
/// Why a value is never torn and never goes backwards:
/// - There are three slots and three places: the producer's `back_`, the consumer's `front_`, and `middle_`. The places start with
///   different slots, and each change is an atomic exchange of one's own slot against the middle one. So the places always hold three
///   different slots, and nobody ever writes a slot that the other reads.
/// - commit() exchanges with release, the consumer's exchange with acquire: so the consumer sees the value that was written before
///   commit(). In the other direction the consumer's release and the producer's acquire order the consumer's last read of a slot
///   before the producer's next write to it. So both sides use acq_rel.
/// - Only the producer sets kNew and only the consumer clears it. Once the consumer has seen kNew, its exchange takes a slot that the
///   producer committed after the last one taken: the producer overwrites the middle with newer slots only.
///
///     Mailbox<HandSample> box;
///     box.publish(sample);                       // a DDS listener
///     if (const HandSample* s = box.take()) ...  // the loop
template <class T>
class Mailbox {
 public:
  Mailbox() = default;
  /// Makes each of the three slots by calling `make_slot()`: for values that own buffers, reserved once and for all.
  template <class Factory>
  requires requires(Factory make) { T(make()); }
  explicit Mailbox(Factory make_slot) : slots_{Slot{make_slot()}, Slot{make_slot()}, Slot{make_slot()}} {}
  Mailbox(const Mailbox&) = delete;
  Mailbox& operator=(const Mailbox&) = delete;

  /// Producer: copies `value` and makes it the newest.
  void publish(const T& value) noexcept {
    writable() = value;
    commit();
  }
  /// Producer: the slot to fill before commit(). It holds some older value: overwrite all of it.
  [[nodiscard]] T& writable() noexcept { return slots_[back_].value; }
  /// Producer: what writable() holds is now the newest value.
  void commit() noexcept { back_ = middle_.exchange(back_ | kNew, std::memory_order_acq_rel) & kIndex; }

  /// Consumer: the newest value when one was published since the last take() or newest(), else null. The pointer is
  /// good until this thread's next call.
  [[nodiscard]] const T* take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return nullptr;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    received_ = true;
    return &slots_[front_].value;
  }
  /// Consumer: copies the newest value out when there is one that was not taken yet.
  [[nodiscard]] bool take_newest(T& out) noexcept {
    const T* value = take();
    if (value != nullptr) out = *value;
    return value != nullptr;
  }
  /// Consumer: the newest value ever published, taken before or not; null when none was. The pointer is good until this
  /// thread's next call.
  [[nodiscard]] const T* newest() noexcept {
    (void)take();
    return received_ ? &slots_[front_].value : nullptr;
  }

 private:
  static constexpr std::uint32_t kIndex = 3;
  static constexpr std::uint32_t kNew = 4;

  // A cache line each, so that the two threads do not slow each other by false sharing.
  struct alignas(64) Slot {
    T value{};
  };
  std::array<Slot, 3> slots_{};
  alignas(64) std::atomic<std::uint32_t> middle_{1};
  alignas(64) std::uint32_t back_ = 0;   // the producer's
  alignas(64) std::uint32_t front_ = 2;  // the consumer's
  bool received_ = false;                // the consumer's
};

}  // namespace mechane::realtime
