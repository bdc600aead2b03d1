#include "server/app/server.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <unistd.h>

#include "server/app/exhibit_changes.hpp"
#include "server/app/exhibit_desk.hpp"
#include "server/app/live_edit.hpp"
#include "server/app/lobby.hpp"
#include "server/app/overload.hpp"
#include "server/app/pace_orders.hpp"
#include "server/app/report.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/version.hpp"
#include "server/app/world_loop.hpp"
#include "server/log/log.hpp"
#include "server/record/recorder.hpp"
#include "server/transport/server_transport.hpp"
#include "server/visits/visit_writer.hpp"

namespace mechane::app {
namespace {

// How often the main thread looks at the kiosks: often enough that visitors do not notice. The loops do not wait for it.
constexpr int kLookEveryMs = 20;
constexpr int kLooksPerStatus = 5;     // ten a second
constexpr int kLooksPerWatchdog = 25;  // twice a second

LoopConfig loop_config(const Settings& settings, std::size_t index) {
  LoopConfig config;
  config.thread.name = fmt::format("loop-{}", index);
  config.thread.fifo_priority = settings.fifo_priority;
  config.thread.lock_memory = settings.fifo_priority > 0;
  if (settings.first_cpu) config.thread.cpu = *settings.first_cpu + static_cast<int>(index);
  config.max_worlds = settings.worlds + 1;  // one more, for when a kiosk goes on to another world
  return config;
}

transport::TransportConfig transport_config(const Settings& settings, const ScenarioStore& scenarios,
                                            const std::optional<proto::ExhibitKey>& exhibit_key) {
  transport::TransportConfig config;
  config.server = settings.name;
  config.version = kVersion;
  config.scenarios = scenarios.ids();
  config.domain = settings.domain;
  config.exhibit_key = exhibit_key;
  // Above the loop's priority: a force that is ready is sent before the next tick begins.
  config.fifo_priority = settings.fifo_priority > 0 ? settings.fifo_priority + 1 : 0;
  return config;
}

}  // namespace

class Server::Impl {
 public:
  explicit Impl(const Settings& settings) : settings_(settings) {}

  Expected<void> start();
  void bring_exhibits_back();
  Expected<void> start_records();
  [[nodiscard]] Expected<std::optional<proto::ExhibitKey>> exhibit_key() const;
  int run(StopSignals& signals);

 private:
  [[nodiscard]] bool loops_run() const;
  void say_ready();
  void look(TimePoint now);
  /// False: whoever gave orders has gone.
  [[nodiscard]] bool follow_orders();
  void follow(const std::string& line);
  void say_status();
  void watch_load(const transport::LoopFigures& loops);

  Settings settings_;
  SystemClock main_clock_;
  // Ends last: it may have to read a scenario to its end, and by then all journals are closed.
  Worker reader_{"exhibits"};
  std::optional<ScenarioStore> scenarios_;
  std::unique_ptr<record::Recorder> recorder_;
  std::unique_ptr<visits::VisitWriter> visit_writer_;
  std::unique_ptr<transport::ServerTransport> transport_;
  std::vector<std::unique_ptr<SystemClock>> clocks_;
  std::vector<std::unique_ptr<WorldLoop>> loops_;
  std::unique_ptr<Lobby> lobby_;
  std::unique_ptr<ExhibitDesk> desk_;
  std::optional<LiveEdit> live_edit_;
  OverloadWatch overload_;
  OrderLines orders_{STDIN_FILENO};
  double pace_ = 1;  ///< the last that was asked for
};

Expected<void> Server::Impl::start() {
  log::info(fmt::format("mechane server {}; settings:\n{}", kVersion, to_string(settings_)));
  auto scenarios = [this] {
    const StopAtOnce while_building;  // building parts may take minutes, and no kiosk is connected yet
    return ScenarioStore::load(settings_);
  }();
  if (!scenarios) return tl::unexpected(scenarios.error());
  scenarios_ = std::move(*scenarios);
  std::vector<std::string> of_settings = scenarios_->ids();
  bring_exhibits_back();
  if (auto started = start_records(); !started) return started;
  auto key = exhibit_key();
  if (!key) return tl::unexpected(key.error());
  auto transport = transport::ServerTransport::start(transport_config(settings_, *scenarios_, *key));
  if (!transport) return tl::unexpected(transport.error());
  transport_ = std::move(*transport);
  for (std::size_t i = 0; i < settings_.loop_threads; ++i) {
    clocks_.push_back(std::make_unique<SystemClock>());
    loops_.push_back(std::make_unique<WorldLoop>(loop_config(settings_, i), *clocks_.back()));
    if (auto started = loops_.back()->start(); !started) return started;
  }
  if (settings_.fifo_priority > 0 && !loops_.front()->thread().report().fifo_granted) {
    log::warning(
        "SCHED_FIFO was refused: the loop runs as an ordinary thread and will be late under load; see 'mechane "
        "doctor'");
  }
  lobby_ = std::make_unique<Lobby>(settings_, *scenarios_, *transport_, recorder_.get(), visit_writer_.get(), loops_);
  live_edit_.emplace(settings_, *scenarios_, *lobby_, reader_);
  desk_ = std::make_unique<ExhibitDesk>(settings_, std::move(of_settings), *scenarios_, *transport_, *lobby_, reader_);
  return {};
}

/// As they were before the restart. Where nobody can tell, the museum opens with those of the settings.
void Server::Impl::bring_exhibits_back() {
  const std::filesystem::path file = settings_.exhibit_changes_file();
  if (file.empty()) return;
  const StopAtOnce while_building;
  const auto changes = read_changes(file);
  if (!changes) return log::warning(changes.error().to_string());
  make_again(*changes, settings_, *scenarios_);
}

/// None where the settings name no file: then exhibits cannot be changed.
Expected<std::optional<proto::ExhibitKey>> Server::Impl::exhibit_key() const {
  const std::filesystem::path file = settings_.exhibit_key_file();
  if (file.empty()) return std::nullopt;
  auto key = proto::ExhibitKey::read_or_make(file);
  if (key) return *key;
  log::warning(key.error().to_string() + "; until then, exhibits cannot be changed");  // the museum opens all the same
  return std::nullopt;
}

Expected<void> Server::Impl::start_records() {
  if (!settings_.records.empty()) {
    record::RecorderConfig config;
    config.folder = settings_.records;
    config.max_journal_bytes = settings_.records_limit_mb * 1'000'000;
    auto recorder = record::Recorder::create(config);
    if (!recorder) return tl::unexpected(recorder.error());
    recorder_ = std::move(*recorder);
  }
  if (const std::filesystem::path file = settings_.visits_file(); !file.empty()) {
    visits::VisitWriterConfig config;
    config.file = file;
    config.keep_days = settings_.visits_keep_days;
    config.max_bytes = settings_.visits_limit_mb * 1'000'000;
    auto writer = visits::VisitWriter::create(config);
    if (!writer) return tl::unexpected(writer.error());
    visit_writer_ = std::move(*writer);
  }
  return {};
}

int Server::Impl::run(StopSignals& signals) {
  const TimePoint began = main_clock_.now();
  bool ready = false;
  for (std::uint64_t looks = 1; !signals.wait(kLookEveryMs); ++looks) {
    const TimePoint now = main_clock_.now();
    if (!ready && loops_run()) {
      ready = true;
      say_ready();
    }
    look(now);
    if (settings_.paced && !follow_orders()) break;
    if (looks % kLooksPerStatus == 0) say_status();
    if (looks % kLooksPerWatchdog == 0) notify_systemd("WATCHDOG=1");
    if (settings_.run_for_s > 0 && std::chrono::duration<double>(now - began).count() >= settings_.run_for_s) break;
  }
  log::info("stopping");
  notify_systemd("STOPPING=1");
  lobby_->close_all();
  for (auto& loop : loops_)
    loop->stop();
  if (settings_.report.empty()) return 0;
  const auto written = write_report(settings_.report, loops_, transport_->haptic_write_time());
  if (written) return 0;
  log::error(written.error());
  return 1;
}

/// Whether each loop has run a tick: one that was started may still wait for a processor, and its kiosks would be without forces.
bool Server::Impl::loops_run() const {
  return std::all_of(loops_.begin(), loops_.end(), [](const auto& loop) { return loop->thread().report().ticks > 0; });
}

void Server::Impl::say_ready() {
  log::info(fmt::format("ready: {} in DDS domain {}, waiting for kiosks", settings_.name, settings_.domain));
  notify_systemd("READY=1");
}

void Server::Impl::look(TimePoint now) {
  for (const transport::News& news : transport_->poll(now))
    lobby_->take(news, now);
  lobby_->take_answers();
  lobby_->follow_signs();
  desk_->look(now);
  if (const std::string done = live_edit_->look(); !done.empty()) {
    fmt::print("{}\n", done);
    std::fflush(stdout);
  }
  lobby_->tidy(now);
}

bool Server::Impl::follow_orders() {
  for (const std::string& line : orders_.take())
    follow(line);
  if (orders_.ended()) log::info("standard input has ended, and with it this server");
  return !orders_.ended();
}

void Server::Impl::follow(const std::string& line) {
  if (const auto edit = parse_edit_order(line)) return live_edit_->order(*edit);
  const auto order = parse_pace_order(line);
  if (!order) return log::warning(order.error().to_string());
  if (order->ticks > 0 && pace_ != 0)
    return log::warning("'" + line + "' has no effect while time runs; write 'pace 0' first");
  if (order->ticks == 0) pace_ = order->pace;
  for (const auto& loop : loops_)
    if (!loop->order(*order)) log::warning("'" + line + "' is lost: too many orders at a time");
}

void Server::Impl::say_status() {
  transport::ServerStatusData status;
  status.worlds = static_cast<std::uint32_t>(lobby_->worlds());
  status.worlds_limit = settings_.worlds;
  status.users = lobby_->users();
  status.loops = summarise(loops_);
  status.records_ok = (recorder_ == nullptr || recorder_->status().records_ok) &&
                      (visit_writer_ == nullptr || visit_writer_->status().ok);
  watch_load(status.loops);
  status.input_gap_ms = to_seconds(overload_.longest_gap()) * 1e3;
  status.overload = overload_.words();
  transport_->publish_server_status(status);
  desk_->publish(main_clock_.now());
}

void Server::Impl::watch_load(const transport::LoopFigures& loops) {
  LoadCounts counts;
  counts.ticks = loops.ticks;
  counts.overruns = loops.overruns;
  counts.held_up = loops.skipped + loops.preemptions;
  counts.input_gaps = transport_->input_gaps();
  counts.longest_gap = transport_->take_longest_input_gap();
  if (lobby_->worlds() == 0) {
    overload_ = OverloadWatch();  // there is no kiosk that could feel it
  } else if (overload_.look(counts, main_clock_.now())) {
    overload_.words().empty() ? log::info("the overload is over") : log::warning(overload_.words());
  }
}

Server::Server(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Server::~Server() = default;

Expected<std::unique_ptr<Server>> Server::start(const Settings& settings) {
  auto impl = std::make_unique<Impl>(settings);
  if (auto started = impl->start(); !started) return tl::unexpected(started.error());
  return std::unique_ptr<Server>(new Server(std::move(impl)));
}

int Server::run(StopSignals& signals) {
  return impl_->run(signals);
}

}  // namespace mechane::app
