#include "server/realtime/periodic_thread.hpp"

#include <algorithm>
#include <future>
#include <system_error>
#include <utility>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include "server/base/thread_setup.hpp"
#include "server/realtime/priority.hpp"

namespace mechane::realtime {
namespace {

constexpr Duration kLongestSleep = std::chrono::milliseconds(20);

// Counters have one writer, the loop, so a load and a store suffice: no locked instruction is needed.
void add(std::atomic<std::uint64_t>& counter, std::uint64_t n = 1) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + n, std::memory_order_relaxed);
}

bool lock_memory() noexcept {
  // Memory that is mapped now is locked in full. Memory that is mapped later is locked page by page as it is touched, so that the
  // stacks of other threads do not cost 8 MiB each.
  return mlockall(MCL_CURRENT) == 0 && mlockall(MCL_FUTURE | MCL_ONFAULT) == 0;
}

}  // namespace

PeriodicThread::PeriodicThread(PeriodicConfig config, Clock& clock) : config_(std::move(config)), clock_(clock) {}

PeriodicThread::~PeriodicThread() {
  stop();
}

Expected<void> PeriodicThread::start(Tick tick) {
  const std::string where = "thread " + config_.name;
  if (thread_.joinable()) return fail(ErrorCode::busy, "it is running already", where, "stop it first");
  if (!tick) return fail(ErrorCode::missing, "it has no function to call", where, "give it a function");
  if (config_.period <= Duration{0})
    return fail(ErrorCode::invalid_value, "the period is not above 0", where, "give it one, such as 1 ms");
  if (config_.fifo_priority < 0 || config_.fifo_priority > 99) {
    return fail(ErrorCode::invalid_value,
                "real-time priority " + std::to_string(config_.fifo_priority) + " is out of range", where,
                "use 1 to 99, or 0 for an ordinary thread");
  }
  if (config_.cpu && (*config_.cpu < 0 || *config_.cpu >= CPU_SETSIZE)) {
    return fail(ErrorCode::invalid_value, "processor " + std::to_string(*config_.cpu) + " is out of range", where,
                "use one that lscpu shows");
  }
  stop_.store(false, std::memory_order_relaxed);
  std::promise<void> ready;
  std::future<void> is_ready = ready.get_future();
  try {
    thread_ = std::thread([this, tick = std::move(tick), &ready]() noexcept {
      prepare();
      ready.set_value();
      run(tick);
      running_.store(false, std::memory_order_release);
    });
  } catch (const std::system_error& e) {
    return fail(ErrorCode::failed_process, std::string("the thread could not be started: ") + e.what(), where,
                "raise the limit of threads (ulimit -u)");
  }
  is_ready.wait();
  return {};
}

void PeriodicThread::request_stop() noexcept {
  stop_.store(true, std::memory_order_relaxed);
}

void PeriodicThread::stop() noexcept {
  request_stop();
  if (thread_.joinable()) thread_.join();
}

PeriodicReport PeriodicThread::report() const noexcept {
  const auto get = [](const auto& value) { return value.load(std::memory_order_relaxed); };
  return {.ticks = get(ticks_),
          .overruns = get(overruns_),
          .preemptions = get(preemptions_),
          .late_wakeups = get(late_wakeups_),
          .skipped = get(skipped_),
          .running = get(running_),
          .fifo_granted = get(fifo_granted_),
          .cpu_granted = get(cpu_granted_),
          .memory_locked = get(memory_locked_)};
}

void PeriodicThread::prepare() noexcept {
  set_up_thread(config_.name);
  // Otherwise the kernel delays an ordinary thread's wake-ups by up to 50 us, to handle several at once.
  prctl(PR_SET_TIMERSLACK, 1UL);
  if (config_.cpu) cpu_granted_.store(pin_to(*config_.cpu), std::memory_order_relaxed);
  if (config_.lock_memory) memory_locked_.store(lock_memory(), std::memory_order_relaxed);
  if (config_.fifo_priority > 0) fifo_granted_.store(take_fifo(config_.fifo_priority), std::memory_order_relaxed);
  running_.store(true, std::memory_order_relaxed);
}

void PeriodicThread::run(const Tick& tick) noexcept {
  TickTiming timing;
  timing.due = clock_.now() + config_.period;
  while (true) {
    const bool slept = sleep_until(timing.due);
    if (stop_.load(std::memory_order_relaxed)) return;
    timing.woke = clock_.now();
    // A tick that follows a long one at once is late because of that one, which is counted already: not a late wake-up.
    if (slept) {
      const Duration late = timing.woke - timing.due;
      wake_latency_.record(late);
      if (late > config_.late_after) add(late_wakeups_);
    }
    run_tick(tick, timing);
    timing = next_after(timing);
  }
}

bool PeriodicThread::sleep_until(TimePoint due) noexcept {
  bool slept = false;
  for (TimePoint now = clock_.now(); now < due && !stop_.load(std::memory_order_relaxed); now = clock_.now()) {
    clock_.sleep_until(std::min(due, now + kLongestSleep));
    slept = true;
  }
  return slept;
}

void PeriodicThread::run_tick(const Tick& tick, const TickTiming& timing) noexcept {
  const Duration cpu_before = clock_.thread_cpu_time();
  tick(timing);
  const Duration cpu = clock_.thread_cpu_time() - cpu_before;
  const Duration wall = clock_.now() - timing.woke;
  cpu_time_.record(cpu);
  wall_time_.record(wall);
  if (cpu > config_.period) {
    add(overruns_);
  } else if (wall > config_.period) {
    add(preemptions_);
  }
  add(ticks_);
}

TickTiming PeriodicThread::next_after(const TickTiming& last) noexcept {
  TickTiming next;
  next.index = last.index + 1;
  next.due = last.due + config_.period;
  const Duration behind = clock_.now() - next.due;
  if (behind >= config_.period) {
    // Go on at the first grid point in the future.
    next.skipped = static_cast<std::uint64_t>(behind / config_.period) + 1;
    next.due += static_cast<std::int64_t>(next.skipped) * config_.period;
    add(skipped_, next.skipped);
  }
  return next;
}

}  // namespace mechane::realtime
