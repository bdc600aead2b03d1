#include "client-sdk/visitor/visit_session.hpp"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "client-sdk/visitor/session_hand.hpp"
#include "server/log/log.hpp"
#include "server/scenario/file_finder.hpp"

namespace mechane::visitor {
namespace {

using client::LinkState;
using state::VisitDescription;
using state::WorldDescription;

constexpr Duration kTick = std::chrono::milliseconds(1);
// Where a step is not done although all its moves were made, a visitor waits so long, and tries again so often.
constexpr Duration kTriesAgainAfter = std::chrono::seconds(5);
constexpr int kTries = 3;
constexpr Duration kLookAgain = std::chrono::milliseconds(100);

/// Plays visits one after another with one client and one hand.
class Session {
 public:
  Session(const VisitOptions& options, const WorldDescription& world, client::Client& client,
          const volatile std::sig_atomic_t& stop)
      : options_(options), world_(world), client_(client), stop_(stop), X_WB_(world.bodies.size()) {
    for (std::size_t i = 0; i < X_WB_.size(); ++i)
      X_WB_[i] = world.bodies[i].X_WB;
  }

  Expected<void> start() {
    auto hand = make_session_hand(options_, world_, client_);
    if (!hand) return tl::unexpected(hand.error());
    hand_ = std::move(*hand);
    next_ = clock_.now();
    return {};
  }

  ActivityReport play(const VisitDescription& visit);
  void release() {
    for (int i = 0; i < 1000; ++i) {
      wait_for_tick();
      if (hand_->release(clock_.now())) return;
    }
  }
  void fill(VisitReport& report) const;

 private:
  void wait_for_tick() {
    next_ += kTick;
    // After a stall, missed ticks are skipped: a hand does not make up for lost time in a burst.
    next_ = std::max(next_, clock_.now() - kTick);
    clock_.sleep_until(next_);
  }
  void tick() {
    wait_for_tick();
    hand_->tick(clock_.now());
    if (++ticks_ % 8 == 0) look();
  }
  void look();
  void act(ActivityReport& report);
  void note_moves(ActivityReport& report) const;
  void note_step(ActivityReport& report);
  /// Whether a step's sign has sent the kiosk on to another scenario.
  [[nodiscard]] bool gone_on() const { return status_ && status_->scenario != world_.id; }
  void note_going_on(ActivityReport& report);
  /// Whether the step's sign opens a scenario that this server does not have: then there is nothing to wait for.
  void note_dead_end(ActivityReport& report) const;
  /// "visit pointing, step choose".
  [[nodiscard]] std::string place(const ActivityReport& report) const;
  void say_what_it_waits_for(const ActivityReport& report) const;
  void come_back();
  void say(const std::string& activity, const std::string& what) const;
  [[nodiscard]] double seconds_since(TimePoint start) {
    return std::chrono::duration<double>(clock_.now() - start).count();
  }

  const VisitOptions& options_;
  const WorldDescription& world_;
  client::Client& client_;
  const volatile std::sig_atomic_t& stop_;
  SystemClock clock_;
  std::unique_ptr<SessionHand> hand_;
  std::vector<Pose> X_WB_;
  client::Frame frame_;
  std::optional<client::WorldStatus> status_;
  TimePoint next_{};
  TimePoint step_began_{};
  std::string step_;
  int tries_ = 0;  // of the step, after the first
  std::uint64_t ticks_ = 0;
};

/// Takes poses and progress from the scene about 120 times a second, as a visitor's eyes would.
void Session::look() {
  if (client_.newest_frame(frame_) && !gone_on()) {
    for (const client::BodyPose& body : frame_.bodies) {
      if (body.object < X_WB_.size()) X_WB_[body.object] = body.X_WB;
    }
  }
  if (ticks_ % 40 == 0) status_ = client_.world_status();
}

void Session::say(const std::string& activity, const std::string& what) const {
  const std::string kiosk = options_.names_kiosk ? options_.client.kiosk + "  " : "";
  std::printf("%s%s: %s\n", kiosk.c_str(), activity.c_str(), what.c_str());
  std::fflush(stdout);
}

void Session::note_step(ActivityReport& report) {
  if (gone_on()) return note_going_on(report);
  if (!status_ || status_->activity != report.name || (status_->step == step_ && !status_->done)) return;
  if (!step_.empty() && !report.steps.empty() && !report.steps.back().done) {
    report.steps.back().seconds = seconds_since(step_began_);
    report.steps.back().done = true;
  }
  if (!status_->done) report.steps.push_back({status_->step, 0, false});
  step_ = status_->done ? std::string() : status_->step;
  step_began_ = clock_.now();
  tries_ = 0;
  hand_->note_step();
  say(report.name, status_->done ? "done" : status_->step);
  note_dead_end(report);
}

/// A millisecond of the visit.
void Session::act(ActivityReport& report) {
  hand_->act({frame_, status_ ? &*status_ : nullptr, X_WB_});
  tick();
  note_moves(report);
}

/// A failed grasp is reported at once, because the following moves usually fail too.
void Session::note_moves(ActivityReport& report) const {
  for (const MoveResult& result : hand_->results().subspan(report.moves.size())) {
    MoveResult& move = report.moves.emplace_back(result);
    if (!move.failed_grasp) continue;
    const std::vector<std::string> none;
    move.reason =
        why_not_grasped(*move.failed_grasp, world_, world_.find_step(step_), status_ ? status_->enabled_agents : none);
    say(report.name, fmt::format("visit {}: {} failed: {}", report.visit, move.name, move.reason));
  }
}

void Session::note_dead_end(ActivityReport& report) const {
  const StepId step = world_.find_step(step_);
  if (!step || world_.steps[step.index()].opens.empty()) return;
  const std::string& opens = world_.steps[step.index()].opens;
  const auto server = client_.server_status();
  if (!server || std::ranges::find(server->scenarios, opens) != server->scenarios.end()) return;
  report.reason = fmt::format("{}: it opens '{}', which this server does not have", place(report), opens);
  say(report.name, report.reason);
}

std::string Session::place(const ActivityReport& report) const {
  return fmt::format("visit {}, {}", report.visit, step_.empty() ? "before its first step" : "step " + step_);
}

void Session::say_what_it_waits_for(const ActivityReport& report) const {
  const StepId step = world_.find_step(step_);
  const bool opens = step && !world_.steps[step.index()].opens.empty();
  const std::string what =
      opens ? fmt::format("the server to open '{}'", world_.steps[step.index()].opens) : "the step to be done";
  say(report.name, fmt::format("{}: all moves made; waiting up to {:.0f} s for {}", place(report),
                               std::chrono::duration<double>(options_.done_within).count(), what));
}

/// The step that opens another scenario may end, with its world, before its beginning was seen.
void Session::note_going_on(ActivityReport& report) {
  const auto sends = std::find_if(world_.steps.begin(), world_.steps.end(),
                                  [&](const auto& step) { return step.opens == status_->scenario; });
  if (!report.steps.empty() && !report.steps.back().done) {
    report.steps.back().seconds = seconds_since(step_began_);
    report.steps.back().done = true;
  }
  report.gone_on_to = status_->scenario;
  report.done = sends != world_.steps.end();  // otherwise somebody else opened another exhibit
  if (report.done && (report.steps.empty() || report.steps.back().name != sends->name))
    report.steps.push_back({sends->name, 0, true});
  say(report.name, "gone on to " + status_->scenario);
  const TimePoint arrived = clock_.now();
  while (stop_ == 0 && clock_.now() - arrived < options_.linger)
    tick();
}

/// Opens the visit's own scenario, as `mechane open` does, where the kiosk is at another: a sign of the previous visit
/// led there, or a display joined first and asked for no scenario.
void Session::come_back() {
  const auto wait_while = [&](auto&& condition) {
    const TimePoint began = clock_.now();
    while (stop_ == 0 && condition() && seconds_since(began) < 5)
      tick();
  };
  status_.reset();
  wait_while([&] { return !status_; });
  if (!gone_on()) return;
  (void)client_.open_exhibit(world_.id);
  wait_while([&] { return gone_on(); });
  for (std::size_t i = 0; i < X_WB_.size(); ++i)
    X_WB_[i] = world_.bodies[i].X_WB;
}

ActivityReport Session::play(const VisitDescription& visit) {
  ActivityReport report;
  report.name = world_.activities[visit.activity.index()].name;
  report.visit = visit.name;
  come_back();
  (void)client_.start_activity(report.name);
  step_.clear();
  status_.reset();
  const TimePoint began = clock_.now();
  step_began_ = began;
  hand_->begin(visit);
  const haptic::LoopStats before = hand_->stats();
  // The hand waits until the world shows the activity's beginning, as a person would.
  while (stop_ == 0 && seconds_since(began) < 5 && !(status_ && status_->activity == report.name && !status_->done))
    tick();
  // A person's reaction time; meanwhile frames of the new beginning arrive.
  for (int i = 0; i < 200 && stop_ == 0; ++i)
    tick();
  TimePoint finished{};
  while (stop_ == 0 && !report.done) {
    act(report);
    note_step(report);
    if (gone_on() || !report.reason.empty()) break;
    report.done = status_ && status_->activity == report.name && status_->done;
    if (report.done || !hand_->finished()) continue;
    if (finished == TimePoint{}) {
      finished = clock_.now();
      say_what_it_waits_for(report);
    }
    const Duration waited = clock_.now() - finished;
    if (waited > options_.done_within) break;
    if (waited < kTriesAgainAfter || tries_ >= kTries) continue;
    ++tries_;
    finished = {};
    say(report.name, place(report) + ": trying it again");
    hand_->try_step_again();
  }
  if (!report.done && report.reason.empty()) {
    report.reason = place(report) + (gone_on()    ? ": somebody else opened " + status_->scenario
                                     : stop_ != 0 ? ": stopped"
                                                  : ": it was not done in time after its last move");
  }
  // The script is played to its end, so that the hand lets go and comes to rest.
  while (stop_ == 0 && report.done && !gone_on() && !hand_->finished())
    act(report);
  report.seconds = seconds_since(began);
  const haptic::LoopStats after = hand_->stats();
  if (after.ticks > before.ticks) {
    report.warm_share =
        static_cast<double>(after.warm_ticks - before.warm_ticks) / static_cast<double>(after.ticks - before.ticks);
  }
  say(report.name,
      fmt::format("visit {}: {}, {:.1f} s", visit.name, report.done ? "done" : "not done", report.seconds));
  return report;
}

void Session::fill(VisitReport& report) const {
  report.loop = hand_->stats();
  report.round_trip = hand_->round_trip();
  const auto status = client_.world_status();
  if (!status) return;
  report.world = status->world;
  for (std::size_t i = 0; i < status->quantities.size() && i < frame_.quantities.size(); ++i) {
    report.quantities.emplace_back(status->quantities[i].name, frame_.quantities[i]);
    if (status->quantities[i].name == "lifted") report.water_l = frame_.quantities[i];
  }
}

/// Waits for a world, and logs at once what it is waiting for.
Expected<void> join(client::Client& client, const VisitOptions& options, const volatile std::sig_atomic_t& stop) {
  SystemClock clock;
  const TimePoint until = clock.now() + options.join_within;
  LinkState said = LinkState::joined;
  while (stop == 0 && clock.now() < until) {
    if (client.wait_for(LinkState::joined, kLookAgain)) return {};
    if (client.state() == said) continue;
    said = client.state();
    log::info(said == LinkState::refused ? client.refusal()
                                         : fmt::format("{}: looking for a server", options.client.kiosk));
  }
  if (stop != 0)
    return fail(ErrorCode::cancelled, "the visitor was stopped before it had joined a world", options.client.kiosk,
                "start it again");
  if (const std::string why = client.refusal(); !why.empty())
    return fail(ErrorCode::busy, why, options.client.kiosk, "then start the visitor again");
  return fail(ErrorCode::not_found, "no server answered", options.client.kiosk,
              "start one with 'mechane server', in the same DDS domain and network");
}

}  // namespace

bool VisitReport::complete() const {
  return !activities.empty() && std::all_of(activities.begin(), activities.end(), [](const auto& a) { return a.done; });
}

Expected<VisitReport> run_visit(const VisitOptions& options, const volatile std::sig_atomic_t& stop) {
  scenario::FileFinder finder;
  x3d::Problems problems(options.scenario.string());
  const auto world = scenario::read_scenario(options.scenario, finder, problems);
  if (!world) return tl::unexpected(world.error());
  const auto visits = choose_visits(options, *world);
  if (!visits) return tl::unexpected(visits.error());
  client::ClientConfig config = options.client;
  if (config.scenario.empty()) config.scenario = world->id;
  auto client = client::Client::connect(config);
  if (!client) return tl::unexpected(client.error());
  if (auto joined = join(**client, options, stop); !joined) return tl::unexpected(joined.error());
  Session session(options, *world, **client, stop);
  if (auto started = session.start(); !started) return tl::unexpected(started.error());
  VisitReport report;
  report.kiosk = options.client.kiosk;
  do {
    report.activities.clear();
    for (const VisitDescription* visit : *visits)
      report.activities.push_back(session.play(*visit));
  } while (options.endless && stop == 0);
  session.release();
  session.fill(report);
  return report;
}

}  // namespace mechane::visitor
