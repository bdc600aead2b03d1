#include "server/realtime/wakeup.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

namespace mechane::realtime {

static_assert(sizeof(std::atomic<std::uint32_t>) == 4 && std::atomic<std::uint32_t>::is_always_lock_free);

void Wakeup::signal() noexcept {
  if (word_.exchange(kSignalled, std::memory_order_acq_rel) == kAsleep) {
    ::syscall(SYS_futex, &word_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
  }
}

bool Wakeup::wait(Duration timeout) noexcept {
  std::uint32_t idle = kIdle;
  if (timeout > Duration{0} && word_.compare_exchange_strong(idle, kAsleep, std::memory_order_acq_rel)) {
    const auto ns = timeout.count();
    const struct timespec relative = {static_cast<time_t>(ns / 1'000'000'000), static_cast<long>(ns % 1'000'000'000)};
    // Returns at once when the word is no longer kAsleep; a wake-up by anything else looks like a timeout, which callers expect.
    ::syscall(SYS_futex, &word_, FUTEX_WAIT_PRIVATE, kAsleep, &relative, nullptr, 0);
  }
  return word_.exchange(kIdle, std::memory_order_acq_rel) == kSignalled;
}

}  // namespace mechane::realtime
