#include "server/base/clock.hpp"

#include <ctime>

namespace mechane {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t read_ns(clockid_t id) noexcept {
  timespec t{};
  clock_gettime(id, &t);
  return static_cast<std::int64_t>(t.tv_sec) * kNsPerSecond + t.tv_nsec;
}

}  // namespace

TimePoint SystemClock::now() noexcept {
  return TimePoint(Duration(read_ns(CLOCK_MONOTONIC)));
}

void SystemClock::sleep_until(TimePoint wake) noexcept {
  const std::int64_t ns = wake.time_since_epoch().count();
  const timespec t{static_cast<time_t>(ns / kNsPerSecond), static_cast<long>(ns % kNsPerSecond)};
  // A signal may cut the sleep short; the wake-up is absolute, so asking again is exact.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) != 0) {
  }
}

Duration SystemClock::thread_cpu_time() noexcept {
  return Duration(read_ns(CLOCK_THREAD_CPUTIME_ID));
}

}  // namespace mechane
