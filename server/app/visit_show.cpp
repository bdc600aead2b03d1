#include "server/app/visit_show.hpp"

#include <algorithm>

#include "server/app/replay.hpp"
#include "server/app/version.hpp"
#include "server/base/clock.hpp"
#include "server/haptics/shown_hands.hpp"
#include "server/transport/server_transport.hpp"
#include "server/world/step.hpp"

namespace mechane::app {
namespace {

constexpr Duration kSomebodyComesWithin = std::chrono::seconds(20);
constexpr Duration kPollEvery = std::chrono::milliseconds(40);

/// The network's side: one world, which the kiosk's clients are given.
class Stage final : public world::Publisher {
 public:
  static Expected<std::unique_ptr<Stage>> open(const std::shared_ptr<const state::WorldDescription>& description,
                                               const world::World& world, const ShowOptions& options) {
    auto transport = transport::ServerTransport::start(
        {.server = options.kiosk, .version = kVersion, .scenarios = {description->id}, .domain = options.domain});
    if (!transport) return tl::unexpected(transport.error());
    const auto port = (*transport)->open_world(options.kiosk, description);
    if (!port) return tl::unexpected(port.error());
    (*transport)->publish_server_status({.worlds = 1, .worlds_limit = 1});
    return std::unique_ptr<Stage>(new Stage(std::move(*transport), **port, world, options.kiosk));
  }
  ~Stage() override { transport_->close_world(port_); }

  /// Lets kiosks in. Whether one of them is in the world.
  bool poll(TimePoint now) {
    for (const transport::News& news : transport_->poll(now))
      if (news.kind == transport::NewsKind::kiosk_appeared && news.session.kiosk == kiosk_)
        transport_->assign_kiosk(kiosk_, port_);
    (void)port_.take_request();
    while (port_.take_answer()) {
    }
    (void)port_.take_language();
    return std::ranges::any_of(transport_->sessions().sessions(), [this](const transport::Session& session) {
      return session.kiosk == kiosk_ && session.was_there && session.scenario == port_.description().id;
    });
  }
  /// Before each tick: whatever clients sent is taken and forgotten.
  void forget_what_came(TimePoint now) noexcept { port_.gather(ignored_, now); }

  void publish_forces(const state::WorldState& /*state*/) noexcept override {}
  void publish(const state::WorldState& state) noexcept override {
    if (transport::WorldPort::shows(state.tick)) shown_.follow(*world_.hand, state);
    port_.publish(state, shown_.out_W());
  }

 private:
  Stage(std::unique_ptr<transport::ServerTransport> transport, transport::WorldPort& port, const world::World& world,
        std::string kiosk)
      : transport_(std::move(transport)), port_(port), world_(world), kiosk_(std::move(kiosk)) {}

  std::unique_ptr<transport::ServerTransport> transport_;
  transport::WorldPort& port_;
  const world::World& world_;
  const std::string kiosk_;
  haptics::ShownHands shown_;
  state::TickInputs ignored_;
};

/// Clients are in a world when they have heard of its state: it is shown to them again and again.
Expected<void> wait_for_somebody(Stage& stage, const state::WorldState& state, Clock& clock) {
  const TimePoint until = clock.now() + kSomebodyComesWithin;
  for (TimePoint now = clock.now(); !stage.poll(now); now = clock.now()) {
    if (now > until)
      return fail(ErrorCode::timed_out, "no display joined the visit in time", {}, "start it from the console again");
    stage.forget_what_came(now);
    stage.publish(state);
    clock.sleep_until(now + kPollEvery);
  }
  return {};
}

}  // namespace

Expected<void> show_visit(const VisitTicks& visit, const std::shared_ptr<const state::WorldDescription>& description,
                          world::WorldConfig config, const ShowOptions& options) {
  auto journal = record::JournalReader::open_file(visit.journal);
  if (!journal) return tl::unexpected(journal.error());
  auto world = world_of_journal(journal->header(), description, std::move(config));
  if (!world) return tl::unexpected(world.error());
  SystemClock clock;
  world::PhaseTimer timer(clock);
  world::NoPublisher nobody;
  record::JournalTick tick;
  bool more = journal->next(tick);
  const auto may_begin = [&] {
    const std::uint64_t now = (*world)->state.tick;
    return now >= visit.first && transport::WorldPort::shows(now);
  };
  for (; more && !tick.after_loss && !may_begin(); more = journal->next(tick))
    world::step(**world, tick.inputs, nobody, timer);
  auto stage = Stage::open(description, **world, options);
  if (!stage) return tl::unexpected(stage.error());
  if (auto came = wait_for_somebody(**stage, (*world)->state, clock); !came) return came;
  const TimePoint began = clock.now();
  TimePoint polled = began;
  for (; more && !tick.after_loss && tick.tick <= visit.last; more = journal->next(tick)) {
    const Duration due = std::chrono::duration_cast<Duration>(
        kTickPeriod * (static_cast<double>(tick.tick - visit.first) / options.speed));
    clock.sleep_until(began + due);
    const TimePoint now = clock.now();
    (*stage)->forget_what_came(now);
    world::step(**world, tick.inputs, **stage, timer);
    if (now - polled < kPollEvery) continue;
    polled = now;
    if (!(*stage)->poll(now)) return {};  // who watched has gone
  }
  return {};
}

}  // namespace mechane::app
