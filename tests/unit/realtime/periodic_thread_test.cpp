#include "server/realtime/periodic_thread.hpp"

#include <atomic>
#include <functional>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"

namespace mechane::realtime {
namespace {

using namespace std::chrono_literals;
using mechane::test::is_error;

// Time that stands still but where a test moves it. Only the loop's thread calls it, and the tick runs there.
class FakeClock final : public Clock {
 public:
  TimePoint now() noexcept override { return time_; }
  void sleep_until(TimePoint wake) noexcept override {
    time_ = std::max(time_, wake);
    ++sleeps_;
    if (sleeps_ == late_at_) time_ += late_by_;
  }
  Duration thread_cpu_time() noexcept override { return cpu_; }

  /// The tick works for so long.
  void work(Duration d) {
    time_ += d;
    cpu_ += d;
  }
  /// The machine takes the processor away from the tick.
  void stall(Duration d) { time_ += d; }
  /// The n-th sleep (from 1) ends late.
  void oversleep(int sleep, Duration by) {
    late_at_ = sleep;
    late_by_ = by;
  }

 private:
  TimePoint time_{1s};
  Duration cpu_{0};
  int sleeps_ = 0;
  int late_at_ = 0;
  Duration late_by_{0};
};

struct Outcome {
  std::vector<TickTiming> ticks;
  PeriodicReport report;
  Duration worst_wake{0};
};

// Runs `count` ticks of 1 ms on the fake clock; `tick(i)` does what the i-th one does.
Outcome run(FakeClock& clock, std::uint64_t count, const std::function<void(std::uint64_t)>& tick,
            PeriodicConfig config = {}) {
  Outcome result;
  PeriodicThread thread(config, clock);
  const auto started = thread.start([&](const TickTiming& timing) {
    result.ticks.push_back(timing);
    tick(timing.index);
    if (timing.index + 1 == count) thread.request_stop();
  });
  EXPECT_TRUE(started.has_value());
  while (thread.report().running)
    std::this_thread::yield();
  thread.stop();
  result.report = thread.report();
  result.worst_wake = thread.wake_latency().max();
  return result;
}

TEST(PeriodicThread, TicksOnTheGridAndCountsNothingWhenAllIsWell) {
  FakeClock clock;
  const Outcome r = run(clock, 100, [&](auto) { clock.work(300us); });
  ASSERT_EQ(r.ticks.size(), 100u);
  for (std::size_t i = 0; i < r.ticks.size(); ++i) {
    EXPECT_EQ(r.ticks[i].due, TimePoint(1s) + (static_cast<int>(i) + 1) * 1ms);
    EXPECT_EQ(r.ticks[i].woke, r.ticks[i].due);
    EXPECT_EQ(r.ticks[i].index, i);
  }
  EXPECT_EQ(r.report.ticks, 100u);
  EXPECT_EQ(r.report.overruns + r.report.preemptions + r.report.late_wakeups + r.report.skipped, 0u);
}

TEST(PeriodicThread, OwnCpuTimeOverThePeriodIsAnOverrunAndNotALateWakeUp) {
  FakeClock clock;
  const Outcome r = run(clock, 10, [&](auto i) { clock.work(i == 3 ? 1300us : 100us); });
  EXPECT_EQ(r.report.overruns, 1u);
  EXPECT_EQ(r.report.preemptions, 0u);
  EXPECT_EQ(r.report.late_wakeups, 0u) << "the next tick is late by our own fault";
  EXPECT_EQ(r.report.skipped, 0u);
  EXPECT_EQ(r.ticks[4].woke - r.ticks[4].due, 300us) << "the next tick follows at once";
  EXPECT_EQ(r.ticks[5].woke, r.ticks[5].due) << "and the one after is on the grid again";
}

TEST(PeriodicThread, WallTimeOverThePeriodWithoutCpuTimeIsAPreemption) {
  FakeClock clock;
  const Outcome r = run(clock, 10, [&](auto i) {
    clock.work(100us);
    if (i == 3) clock.stall(1200us);
  });
  EXPECT_EQ(r.report.preemptions, 1u);
  EXPECT_EQ(r.report.overruns, 0u);
  EXPECT_EQ(r.report.late_wakeups, 0u);
}

TEST(PeriodicThread, AWakeUpOverTheThresholdIsLate) {
  FakeClock clock;
  clock.oversleep(5, 400us);
  const Outcome r = run(clock, 10, [&](auto) { clock.work(100us); });
  EXPECT_EQ(r.report.late_wakeups, 1u);
  EXPECT_EQ(r.report.overruns + r.report.preemptions + r.report.skipped, 0u);
  EXPECT_EQ(r.worst_wake, 400us);
}

TEST(PeriodicThread, AfterALongStallItSkipsToTheNextGridPointWithoutABurst) {
  FakeClock clock;
  clock.oversleep(5, 30'250us);
  const Outcome r = run(clock, 10, [&](auto) { clock.work(100us); });
  EXPECT_EQ(r.report.late_wakeups, 1u);
  EXPECT_EQ(r.report.skipped, 30u);
  ASSERT_EQ(r.ticks.size(), 10u);
  EXPECT_EQ(r.ticks[4].woke - r.ticks[4].due, 30'250us);
  EXPECT_EQ(r.ticks[5].skipped, 30u);
  EXPECT_EQ(r.ticks[5].due - r.ticks[4].due, 31ms);
  EXPECT_EQ(r.ticks[5].woke, r.ticks[5].due);
  EXPECT_EQ(r.ticks[6].due - r.ticks[5].due, 1ms);
}

TEST(PeriodicThread, AnOverrunOfManyPeriodsIsOneOverrunAndItsSkips) {
  FakeClock clock;
  const Outcome r = run(clock, 5, [&](auto i) { clock.work(i == 1 ? 5ms : 100us); });
  EXPECT_EQ(r.report.overruns, 1u);
  EXPECT_EQ(r.report.skipped, 5u) << "the tick ended on a grid point; the first one in the future is the next";
  EXPECT_EQ(r.ticks[2].woke, r.ticks[2].due);
}

TEST(PeriodicThread, RefusesABadConfiguration) {
  FakeClock clock;
  const auto error_of = [&](auto change) {
    PeriodicConfig config;
    config.name = "loop";
    change(config);
    const auto started = PeriodicThread(config, clock).start([](const TickTiming&) {});
    return started ? Error{} : started.error();
  };
  const auto wrong = [](const char* word) { return is_error(ErrorCode::invalid_value, 0, {"thread loop", word}); };
  EXPECT_EQ(error_of([](PeriodicConfig&) {}).what, "");
  EXPECT_THAT(error_of([](PeriodicConfig& c) { c.period = 0ms; }), wrong("period"));
  EXPECT_THAT(error_of([](PeriodicConfig& c) { c.fifo_priority = 100; }), wrong("100"));
  EXPECT_THAT(error_of([](PeriodicConfig& c) { c.cpu = -1; }), wrong("-1"));
  PeriodicThread thread({}, clock);
  EXPECT_THAT(thread.start(nullptr).error(), is_error(ErrorCode::missing, 0));
}

TEST(PeriodicThread, ASecondStartIsRefusedAndASecondLifeIsNot) {
  SystemClock clock;
  PeriodicThread thread({}, clock);
  ASSERT_TRUE(thread.start([](const TickTiming&) {}).has_value());
  const auto again = thread.start([](const TickTiming&) {});
  ASSERT_FALSE(again.has_value());
  EXPECT_THAT(again.error(), is_error(ErrorCode::busy, 0));
  thread.stop();
  EXPECT_FALSE(thread.report().running);
  ASSERT_TRUE(thread.start([](const TickTiming&) {}).has_value());
  EXPECT_TRUE(thread.report().running);
}

TEST(PeriodicThread, StopIsPromptWhateverThePeriod) {
  SystemClock clock;
  PeriodicConfig config;
  config.period = 1h;
  PeriodicThread thread(config, clock);
  ASSERT_TRUE(thread.start([](const TickTiming&) {}).has_value());
  const TimePoint before = clock.now();
  thread.stop();
  EXPECT_LT(clock.now() - before, 2s);
  EXPECT_EQ(thread.report().ticks, 0u);
}

// On the real clock only what holds on any machine is asked: the grid, and that every grid point is either run or counted.
TEST(PeriodicThread, AccountsForEveryGridPointOnARealClock) {
  SystemClock clock;
  PeriodicConfig config;
  config.name = "a name longer than fifteen bytes";
  config.fifo_priority = 10;
  config.cpu = sched_getcpu();
  PeriodicThread thread(config, clock);
  std::atomic<std::uint64_t> counted{0};
  std::atomic<bool> on_grid{true};
  TimePoint first;
  const auto started = thread.start([&](const TickTiming& t) {
    if (t.index == 0) first = t.due;
    counted += 1 + t.skipped;
    const Duration expected = static_cast<std::int64_t>(counted.load() - 1) * kTickPeriod;
    if (t.due - first != expected || t.woke < t.due) on_grid = false;
    if (counted >= 200) thread.request_stop();
  });
  ASSERT_TRUE(started.has_value());
  const PeriodicReport at_start = thread.report();
  while (thread.report().running)
    std::this_thread::yield();
  thread.stop();
  const PeriodicReport report = thread.report();
  EXPECT_TRUE(on_grid);
  EXPECT_TRUE(at_start.cpu_granted);
  EXPECT_GE(report.ticks + report.skipped, 200u);
  EXPECT_EQ(thread.wall_time().count(), report.ticks);
  EXPECT_EQ(thread.cpu_time().count(), report.ticks);
}

TEST(PeriodicThread, ATickAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  FakeClock clock;
  PeriodicThread thread({}, clock);
  std::optional<test::AllocationGuard> guard;  // counts for the thread that makes it: the loop's
  std::uint64_t allocations = 1;
  ASSERT_TRUE(thread
                  .start([&](const TickTiming& t) {
                    if (t.index == 0) guard.emplace();
                    if (t.index != 1000) return;
                    allocations = guard->allocations();
                    thread.request_stop();
                  })
                  .has_value());
  while (thread.report().running)
    std::this_thread::yield();
  thread.stop();
  EXPECT_EQ(allocations, 0u);
}

}  // namespace
}  // namespace mechane::realtime
