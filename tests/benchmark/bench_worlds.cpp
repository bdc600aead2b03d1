// What a museum's worlds cost one core. Each scenario is loaded from cached parts; its good visits are played, and what
// the server took in is played again, as fast as the machine can, each tick timed by the thread's own CPU clock. Then
// more and more worlds, of mixed exhibits, are stepped one after another in every millisecond.
#include <algorithm>
#include <array>
#include <future>
#include <iostream>
#include <map>
#include <memory>
#include <numeric>
#include <vector>

#include <CLI/CLI.hpp>

#include "server/app/scenario_store.hpp"
#include "server/log/log.hpp"
#include "server/realtime/periodic_thread.hpp"
#include "server/world/step.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane::benchmark {
namespace {

struct Config {
  std::vector<std::string> scenarios;
  double seconds = 5;
  int priority = 80;
  int most = 48;
};

constexpr std::size_t kLoads = 3;       // counted; the one before them fills the cache
constexpr std::size_t kReplays = 2;     // of each visit
constexpr double kOverrunShare = 1e-3;  // of the ticks: with fewer, one core holds the worlds
// A tick that took so much longer on the wall than on the processor was interrupted: its phases tell nothing.
constexpr Duration kInterrupted = std::chrono::microseconds(10);
// Where seats begin in their visits: steps of the golden ratio fill an interval evenly, however many there are.
constexpr double kGoldenShare = 0.6180339887498949;

/// What the server took in, in one tick of one visitor.
struct Taken {
  state::UserInput user;
  state::Command command;  // of kind none where there was none
};

struct Visit {
  std::string name;
  std::vector<Taken> ticks;
  std::uint64_t state_hash = 0;  // as the visitor's player left the world
};

/// A scenario, and its good visits.
struct Show {
  std::string name;
  std::shared_ptr<const state::WorldDescription> description;
  world::WorldConfig config;
  std::vector<Visit> visits;
  double mean_us = 0;  // of a tick

  [[nodiscard]] Expected<std::unique_ptr<world::World>> open() const {
    return world::World::create(description, config);
  }
};

/// One world into which a visit is fed again.
class Feed {
 public:
  Feed(std::unique_ptr<world::World> world, const Visit& visit) : world_(std::move(world)), visit_(&visit) {}

  /// The first half of a tick. At the visit's end the hand stays where it is.
  void feel(world::PhaseTimer& timer) noexcept {
    if (index_ < visit_->ticks.size()) {
      const Taken& taken = visit_->ticks[index_];
      inputs_.users[0] = taken.user;
      inputs_.commands[0] = taken.command;
      inputs_.command_count = taken.command.kind == state::CommandKind::none ? 0 : 1;
    } else {
      ++inputs_.users[0].sample.sequence;
    }
    ++index_;
    world::feel(*world_, inputs_, publisher_, timer);
  }
  void move(world::PhaseTimer& timer) noexcept { world::move(*world_, publisher_, timer); }
  void step(world::PhaseTimer& timer) noexcept {
    feel(timer);
    move(timer);
  }
  [[nodiscard]] std::size_t left() const { return visit_->ticks.size() - std::min(index_, visit_->ticks.size()); }
  [[nodiscard]] std::uint64_t state_hash() const { return state::state_hash(world_->state); }

 private:
  std::unique_ptr<world::World> world_;
  const Visit* visit_;
  std::size_t index_ = 0;
  state::TickInputs inputs_;
  world::NoPublisher publisher_;
};

/// Ticks of all visits of a scenario.
struct Ticks {
  explicit Ticks(std::size_t count) : every(count * kReplays), floor(count) {}

  Samples every;
  Samples floor;  // of each tick its fastest replay: the work is the same, so what was more is the machine's
  std::array<Duration, world::kPhases> phases{};  // of those that nobody interrupted
  std::size_t uninterrupted = 0;
  Duration sum{};
};

Expected<Show> load(const std::string& file, Report& report) {
  app::Settings settings;
  settings.scenarios = {file};
  Show show;
  std::vector<double> took;
  SystemClock clock;
  for (std::size_t i = 0; i <= kLoads; ++i) {
    const TimePoint began = clock.now();
    const auto store = app::ScenarioStore::load(settings);
    if (!store) return tl::unexpected(store.error());
    const auto world = world::World::create(store->first(), store->world_config());
    if (!world) return tl::unexpected(world.error());
    if (i > 0) took.push_back(to_seconds(clock.now() - began));
    show.description = store->first();
    show.config = store->world_config();
  }
  std::ranges::sort(took);
  show.name = show.description->id;
  report.metric("load_s." + show.name, took[kLoads / 2]);
  return show;
}

/// Came to the activity's end, or to a step that leads elsewhere.
bool went_well(const state::WorldDescription& world, const test::PlayedVisit& played) {
  return played.done || std::ranges::any_of(played.steps, [&](const auto& step) {
           return !world.steps[world.find_step(step.name).index()].opens.empty();
         });
}

/// The first visit of each activity: those that go well stand first.
void play(Show& show, Report& report) {
  const test::Exhibit exhibit(show.description, show.config);
  for (std::size_t i = 0; i < show.description->activities.size(); ++i) {
    const auto& visits = show.description->visits;
    const auto found = std::ranges::find_if(visits, [&](const auto& visit) { return visit.activity.index() == i; });
    if (found == visits.end()) {
      report.note(show.name + ": no visit of '" + show.description->activities[i].name + "', not measured");
      continue;
    }
    Visit& visit = show.visits.emplace_back();
    visit.name = found->name;
    test::PlayOptions options;
    options.record = [&](const state::TickInputs& inputs) {
      visit.ticks.push_back({inputs.users[0], inputs.command_count > 0 ? inputs.commands[0] : state::Command{}});
    };
    const test::PlayedVisit played = exhibit.play(visit.name, options);
    visit.state_hash = played.state_hash;
    if (!went_well(*show.description, played)) {
      report.note(show.name + ": the visit '" + visit.name + "' stopped at '" + played.stopped_at + "'");
    }
  }
}

/// True when the world ended as it did when the visit was played.
Expected<bool> replay(const Show& show, const Visit& visit, Ticks& ticks, std::vector<Duration>& fastest) {
  auto world = show.open();
  if (!world) return tl::unexpected(world.error());
  Feed feed(std::move(*world), visit);
  SystemClock clock;
  world::PhaseTimer timer(clock);
  for (Duration& least : fastest) {
    const Duration began = clock.thread_cpu_time();
    feed.step(timer);
    const Duration took = clock.thread_cpu_time() - began;
    ticks.every.add(took);
    ticks.sum += took;
    least = std::min(least, took);
    const auto& phases = timer.took();
    if (std::accumulate(phases.begin(), phases.end(), Duration{}) > took + kInterrupted) continue;
    ++ticks.uninterrupted;
    std::ranges::transform(phases, ticks.phases, ticks.phases.begin(), std::plus<>{});
  }
  return feed.state_hash() == visit.state_hash;
}

void report_ticks(const std::string& name, Ticks& ticks, Report& report) {
  report.distribution("tick_us." + name, ticks.every);
  report.metric("tick_us." + name + ".mean", to_us(ticks.sum) / static_cast<double>(ticks.every.size()));
  report.distribution("tick_floor_us." + name, ticks.floor);
  constexpr double kPercentOfTick = 1e-1;  // of 1000 us
  report.metric("budget_pct." + name + ".median", ticks.every.quantile_us(0.5) * kPercentOfTick);
  report.metric("budget_pct." + name + ".p999", ticks.every.quantile_us(0.999) * kPercentOfTick);
  if (ticks.uninterrupted == 0) return;
  for (std::size_t i = 0; i < world::kPhases; ++i) {
    report.metric("phase_us." + name + "." + std::string(world::kPhaseNames[i]),
                  to_us(ticks.phases[i]) / static_cast<double>(ticks.uninterrupted));
  }
}

/// Loads, plays and times one scenario; `stable` becomes false when a replay ends elsewhere.
Expected<Show> measure(const std::string& file, Report& report, bool& stable) {
  auto show = load(file, report);
  if (!show) return show;
  std::cerr << "bench_worlds: " << show->name << "\n";
  play(*show, report);
  if (show->visits.empty())
    return fail(ErrorCode::missing, "no visit of any activity", file, "write one under 'visits', or leave it out");
  std::size_t count = 0;
  for (const Visit& visit : show->visits)
    count += visit.ticks.size();
  Ticks ticks(count);
  for (const Visit& visit : show->visits) {
    std::vector<Duration> fastest(visit.ticks.size(), Duration::max());
    for (std::size_t i = 0; i < kReplays; ++i) {
      const auto same = replay(*show, visit, ticks, fastest);
      if (!same) return tl::unexpected(same.error());
      if (*same) continue;
      stable = false;
      report.note(show->name + ": the visit '" + visit.name + "', played again, ended in another state");
    }
    for (const Duration least : fastest)
      ticks.floor.add(least);
  }
  report_ticks(show->name, ticks, report);
  show->mean_us = to_us(ticks.sum) / static_cast<double>(ticks.every.size());
  return show;
}

/// A place at which one visitor follows another, all at one exhibit.
class Seat {
 public:
  Seat(const Show& show, std::size_t number) : show_(&show), number_(number) {}

  /// Somewhere in a visit with so many ticks before it, where it is that long; a new visitor unless the present one
  /// stays as long.
  Expected<void> prepare(std::size_t ticks) {
    if (feed_ && feed_->left() >= ticks) return {};
    const std::size_t turn = number_ + visitors_++;
    const Visit& visit = show_->visits[turn % show_->visits.size()];
    auto world = show_->open();
    if (!world) return tl::unexpected(world.error());
    feed_ = std::make_unique<Feed>(std::move(*world), visit);
    const std::size_t spare = visit.ticks.size() - std::min(ticks, visit.ticks.size());
    const double share = std::fmod(kGoldenShare * static_cast<double>(turn + 1), 1.0);
    SystemClock clock;
    world::PhaseTimer timer(clock);
    const auto skip = static_cast<std::size_t>(share * static_cast<double>(spare));
    for (std::size_t i = 0; i < skip; ++i)
      feed_->step(timer);
    return {};
  }
  void feel(world::PhaseTimer& timer) noexcept { feed_->feel(timer); }
  void move(world::PhaseTimer& timer) noexcept { feed_->move(timer); }

 private:
  const Show* show_;
  std::size_t number_;
  std::size_t visitors_ = 0;
  std::unique_ptr<Feed> feed_;
};

struct Paced {
  realtime::PeriodicReport counted;
  realtime::LatencyHistogram cpu_time;     // of all worlds' ticks in one millisecond
  realtime::LatencyHistogram third_later;  // the third world's force after the first's

  [[nodiscard]] double overrun_share() const {
    return static_cast<double>(counted.overruns) / static_cast<double>(counted.ticks);
  }
};

/// Steps all seats in each millisecond, for `ticks` of them, in two halves as the server's loop does.
Expected<Paced> pace(std::vector<Seat>& seats, std::uint64_t ticks, int priority) {
  for (Seat& seat : seats) {
    if (auto ready = seat.prepare(ticks); !ready) return tl::unexpected(ready.error());
  }
  SystemClock clock;
  realtime::PeriodicConfig config;
  config.name = "bench_worlds";
  config.fifo_priority = priority;
  realtime::PeriodicThread loop(config, clock);
  SystemClock phases_clock;
  world::PhaseTimer timer(phases_clock);
  std::promise<void> done;
  std::uint64_t left = ticks;
  realtime::LatencyHistogram third_later;
  auto started = loop.start([&](const realtime::TickTiming&) {
    if (left == 0) return;
    TimePoint first{};
    for (std::size_t i = 0; i < seats.size(); ++i) {
      seats[i].feel(timer);
      if (i == 0) first = phases_clock.now();
      if (i == 2) third_later.record(phases_clock.now() - first);
    }
    for (Seat& seat : seats)
      seat.move(timer);
    if (--left > 0) return;
    loop.request_stop();
    done.set_value();
  });
  if (!started) return tl::unexpected(started.error());
  done.get_future().wait();
  loop.stop();
  return Paced{loop.report(), loop.cpu_time(), third_later};
}

/// One core, and more or fewer worlds on it. The dearest exhibits take their seats first.
class Core {
 public:
  Core(std::vector<Show>& shows, const Config& config, Report& report)
      : shows_(shows), config_(config), report_(report) {
    std::ranges::sort(shows_, std::greater<>{}, &Show::mean_us);
  }

  /// Steps so many worlds; where too many ticks took over a millisecond, once more: that may have been the machine's.
  Expected<bool> holds(std::size_t count) {
    while (seats_.size() > count)
      seats_.pop_back();
    while (seats_.size() < count)
      seats_.emplace_back(shows_[seats_.size() % shows_.size()], seats_.size());
    std::cerr << "bench_worlds: " << count << (count == 1 ? " world" : " worlds") << "\n";
    const auto ticks = static_cast<std::uint64_t>(config_.seconds * 1000);
    auto paced = pace(seats_, ticks, config_.priority);
    if (paced && paced->overrun_share() >= kOverrunShare) paced = pace(seats_, ticks, config_.priority);
    if (!paced) return tl::unexpected(paced.error());
    if (runs_.empty() && config_.priority > 0 && !paced->counted.fifo_granted)
      report_.note("worlds: SCHED_FIFO was refused, ordinary priority");
    const bool held = paced->overrun_share() < kOverrunShare;
    runs_.insert_or_assign(count, std::move(*paced));
    return held;
  }

  void report() const {
    for (const auto& [name, share] : {std::pair{"median", 0.5}, std::pair{"p99", 0.99}, std::pair{"p999", 0.999}}) {
      std::vector<std::array<double, 2>> curve;
      for (const auto& [count, paced] : runs_)
        curve.push_back({static_cast<double>(count), to_us(paced.cpu_time.quantile(share))});
      report_.curve("worlds." + std::string(name), curve);
    }
    for (const auto& [count, paced] : runs_) {
      report_.metric("worlds_over_pct." + std::to_string(count), 100 * paced.overrun_share());
      report_.metric("worlds_tick_us." + std::to_string(count) + ".median", to_us(paced.cpu_time.quantile(0.5)));
    }
    if (const auto three = runs_.find(3); three != runs_.end()) {
      report_.metric("force_later_us.third.median", to_us(three->second.third_later.quantile(0.5)));
      report_.metric("force_later_us.third.p99", to_us(three->second.third_later.quantile(0.99)));
    }
  }

 private:
  std::vector<Show>& shows_;
  const Config& config_;
  Report& report_;
  std::vector<Seat> seats_;
  std::map<std::size_t, Paced> runs_;
};

/// More worlds, in growing strides, until a core does not hold them; then between the two.
Expected<void> fill_core(std::vector<Show>& shows, const Config& config, Report& report) {
  double mean_us = 0;
  for (const Show& show : shows)
    mean_us += show.mean_us / static_cast<double>(shows.size());
  report.metric("worlds_per_core.computed", 1e3 / mean_us);
  Core core(shows, config, report);
  const auto most = static_cast<std::size_t>(config.most);
  std::size_t held = 0, too_many = most + 1;
  while (held + 1 < too_many) {
    const bool growing = too_many > most;
    const std::size_t next = growing ? std::min(most, held + 1 + held / 4) : (held + too_many) / 2;
    const auto holds = core.holds(next);
    if (!holds) return tl::unexpected(holds.error());
    (*holds ? held : too_many) = next;
  }
  if (held == most) report.note("worlds_per_core: no more than " + std::to_string(most) + " were tried");
  report.metric("worlds_per_core", static_cast<double>(held));
  core.report();
  return {};
}

Expected<void> measure_all(const Config& config, Report& report) {
  std::vector<Show> shows;
  bool stable = true;
  for (const std::string& file : config.scenarios) {
    auto show = measure(file, report, stable);
    if (!show) return tl::unexpected(show.error());
    shows.push_back(std::move(*show));
  }
  report.metric("state_hash.stable", stable ? 1 : 0);
  return fill_core(shows, config, report);
}

int main_of(const Config& config) {
  Report report;
  const auto measured = measure_all(config, report);
  if (!measured) {
    std::cerr << "bench_worlds: " << measured.error().to_string() << "\n";
    return 1;
  }
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::log::start("bench_worlds", mechane::log::Level::warning);
  mechane::benchmark::Config config;
  CLI::App app{"Times the ticks of each scenario's visits, and how many worlds one core holds"};
  app.add_option("SCENARIO", config.scenarios, "X3D files")->required();
  app.add_option("--seconds", config.seconds, "how long each number of worlds is stepped")
      ->check(CLI::Range(0.1, 600.0));
  app.add_option("--priority", config.priority, "SCHED_FIFO priority of that; 0: none")->check(CLI::Range(0, 99));
  app.add_option("--most", config.most, "the largest number of worlds tried")->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::main_of(config);
}
