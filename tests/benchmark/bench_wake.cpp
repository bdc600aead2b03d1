// How late the loop's thread wakes, with nothing to do in a tick: the same question that cyclictest asks.
#include <chrono>
#include <future>
#include <iostream>

#include <CLI/CLI.hpp>

#include "server/realtime/periodic_thread.hpp"
#include "tests/benchmark/bench_stats.hpp"

namespace mechane::benchmark {
namespace {

struct Config {
  int priority = 80;
  int cpu = 0;
  double seconds = 5;
};

int run(const Config& config) {
  const auto ticks = static_cast<std::uint64_t>(config.seconds * 1000);
  Samples late(ticks);
  std::promise<void> done;
  SystemClock clock;
  realtime::PeriodicThread loop(
      {.name = "bench_wake", .fifo_priority = config.priority, .cpu = config.cpu, .lock_memory = true}, clock);
  const auto started = loop.start([&](const realtime::TickTiming& timing) {
    late.add(timing.woke - timing.due);
    if (timing.index + 1 == ticks) {
      loop.request_stop();
      done.set_value();
    }
  });
  if (!started) {
    std::cerr << "bench_wake: " << started.error().to_string() << "\n";
    return 1;
  }
  done.get_future().wait();
  loop.stop();

  Report report;
  const auto counted = loop.report();
  report.distribution("wake_us", late);
  report.metric("wake.late", static_cast<double>(counted.late_wakeups));
  report.metric("wake.skipped", static_cast<double>(counted.skipped));
  if (config.priority > 0 && !counted.fifo_granted) report.note("wake: SCHED_FIFO was refused, ordinary priority");
  if (!counted.cpu_granted) report.note("wake: the thread could not be pinned");
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"Wake-up latency of the 1 kHz loop with an empty tick"};
  app.add_option("--priority", config.priority, "SCHED_FIFO priority; 0: none")->check(CLI::Range(0, 99));
  app.add_option("--cpu", config.cpu, "processor to pin to")->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", config.seconds, "how long")->check(CLI::Range(0.1, 3600.0));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::run(config);
}
