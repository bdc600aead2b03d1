// What a tick costs: the shipped scenario, paced at 1 kHz as the server paces it, with one hand that holds the crank
// and turns it. Publishing goes nowhere here: what the network and the journal add is in the server's own report.
#include <array>
#include <future>
#include <iostream>
#include <memory>
#include <vector>

#include <CLI/CLI.hpp>

#include "server/app/scenario_store.hpp"
#include "server/log/log.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/world/step.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/visit_hand.hpp"

namespace mechane::benchmark {
namespace {

struct Config {
  std::string scenario;
  std::string activity = "use";
  int priority = 80;
  double seconds = 15;
};

constexpr double kTurnsPerSecond = 0.5;
constexpr std::uint64_t kWarmUp = 1000;  // ticks: the hand has its grip by then

// One world, its hand and what its ticks took.
class Run {
 public:
  Run(std::unique_ptr<world::World> world, test::ScriptedHand hand, std::uint32_t activity, std::uint64_t ticks)
      : world_(std::move(world)), hand_(hand), activity_(activity), ticks_(ticks), whole_(ticks) {
    for (std::size_t i = 0; i < world::kPhases; ++i)
      phases_.emplace_back(ticks);
  }

  /// True when it was the last one.
  bool tick(std::uint64_t index) {
    state::TickInputs inputs;
    if (index == 0) {
      inputs.commands[0] = {1, state::CommandKind::start_activity, activity_};
      inputs.command_count = 1;
    } else {
      inputs.users[0] = hand_.sample(index);
    }
    const TimePoint began = clock_.now();
    world::step(*world_, inputs, publisher_, timer_);
    const Duration took = clock_.now() - began;
    if (index < kWarmUp) return false;
    whole_.add(took);
    for (std::size_t i = 0; i < world::kPhases; ++i)
      phases_[i].add(timer_.took()[i]);
    held_ += world_->state.users[0].grasp.active ? 1 : 0;
    return index + 1 == kWarmUp + ticks_;
  }

  void report(Report& report) {
    report.distribution("tick_us", whole_);
    for (std::size_t i = 0; i < world::kPhases; ++i)
      report.distribution("phase_us." + std::string(world::kPhaseNames[i]), phases_[i]);
    report.metric("tick.held_share", static_cast<double>(held_) / static_cast<double>(ticks_));
  }
  [[nodiscard]] bool held_throughout() const { return held_ == ticks_; }

  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

 private:
  std::unique_ptr<world::World> world_;
  test::ScriptedHand hand_;
  std::uint32_t activity_;
  std::uint64_t ticks_;
  std::uint64_t held_ = 0;
  SystemClock clock_;
  world::NoPublisher publisher_;
  world::PhaseTimer timer_{clock_};
  Samples whole_;
  std::vector<Samples> phases_;
};

Expected<std::unique_ptr<Run>> make_run(const Config& config) {
  app::Settings settings;
  settings.scenarios = {config.scenario};
  auto store = app::ScenarioStore::load(settings);
  if (!store) return tl::unexpected(store.error());
  const auto description = store->first();
  const auto hand = test::visit_hand(*description, config.activity, 2 * kPi * kTurnsPerSecond);
  if (!hand)
    return fail(ErrorCode::unknown_name, "no visit of '" + config.activity + "' that reaches and turns",
                config.scenario, "name another activity");
  auto world = world::World::create(description, store->world_config());
  if (!world) return tl::unexpected(world.error());
  const auto activity = static_cast<std::uint32_t>(description->find_activity(config.activity).index());
  return std::make_unique<Run>(std::move(*world), *hand, activity, static_cast<std::uint64_t>(config.seconds * 1000));
}

Expected<void> pace(Run& run, int priority, Report& report) {
  std::promise<void> done;
  SystemClock clock;
  realtime::PeriodicConfig config;
  config.name = "bench_tick";
  config.fifo_priority = priority;
  config.lock_memory = true;
  realtime::PeriodicThread loop(config, clock);
  bool ended = false;
  auto started = loop.start([&](const realtime::TickTiming& timing) {
    if (ended || !run.tick(timing.index)) return;
    ended = true;
    loop.request_stop();
    done.set_value();
  });
  if (!started) return started;
  done.get_future().wait();
  loop.stop();
  const auto counted = loop.report();
  report.metric("tick.overruns", static_cast<double>(counted.overruns));
  report.metric("tick.late_wakeups", static_cast<double>(counted.late_wakeups));
  report.metric("tick.preemptions", static_cast<double>(counted.preemptions));
  if (priority > 0 && !counted.fifo_granted) report.note("tick: SCHED_FIFO was refused, ordinary priority");
  return {};
}

int main_of(const Config& config) {
  auto run = make_run(config);
  Report report;
  const auto paced = run ? pace(**run, config.priority, report) : tl::unexpected(run.error());
  if (!paced) {
    std::cerr << "bench_tick: " << paced.error().to_string() << "\n";
    return 1;
  }
  (*run)->report(report);
  if (!(*run)->held_throughout())
    report.note("tick: the hand did not hold the crank in every tick, see tick.held_share");
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::log::start("bench_tick", mechane::log::Level::warning);
  mechane::benchmark::Config config;
  CLI::App app{"Times the ticks of a scenario's world with one hand at work"};
  app.add_option("--scenario", config.scenario, "X3D file")->required();
  app.add_option("--activity", config.activity, "what the hand does");
  app.add_option("--priority", config.priority, "SCHED_FIFO priority; 0: none")->check(CLI::Range(0, 99));
  app.add_option("--seconds", config.seconds, "how long")->check(CLI::Range(1.0, 3600.0));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::main_of(config);
}
