// The newest value of one thread for one other thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace mechane::drivers {

/// For exactly one thread that puts and one that takes; T is trivially copyable. Neither call waits or allocates.
///
/// Of three slots each thread owns one, and the third lies between them. Each call swaps the caller's slot for that one
/// by an atomic exchange, so no slot ever has two owners and no value is torn. The swap acquires what the other thread
/// wrote and releases what this one did. The bit kNew tells whether the middle slot holds a value that was not taken.
template <class T>
class NewestValue {
 public:
  /// Overwrites a value that was not taken.
  void put(const T& value) noexcept {
    slots_[putting_] = value;
    putting_ = middle_.exchange(putting_ | kNew, std::memory_order_acq_rel) & ~kNew;
  }
  /// False, with `into` untouched, when nothing was put since the last call.
  [[nodiscard]] bool take(T& into) noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kNew) == 0) return false;
    taking_ = middle_.exchange(taking_, std::memory_order_acq_rel) & ~kNew;
    into = slots_[taking_];
    return true;
  }

 private:
  static constexpr std::uint32_t kNew = 4;

  std::array<T, 3> slots_{};
  std::atomic<std::uint32_t> middle_{0};
  std::uint32_t putting_ = 1;  // owned by the thread that puts
  std::uint32_t taking_ = 2;   // owned by the thread that takes
};

}  // namespace mechane::drivers
