#include "tests/support/exhibit_play.hpp"

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "server/app/scenario_store.hpp"
#include "server/realtime/histogram.hpp"
#include "server/transport/world_port.hpp"
#include "server/world/step.hpp"
#include "tests/support/scripted_client.hpp"
#include "tests/support/source_folder.hpp"

namespace mechane::test {
namespace {

// A person's reaction time before the hand sets out.
constexpr std::uint64_t kReactionTicks = 200;
// Where a removed part is put: out of any snap's reach.
constexpr double kUnderTheFloorM = 3;

template <class T>
T value_or_throw(Expected<T> result) {
  if (!result) throw std::runtime_error(result.error().to_string());
  return std::move(*result);
}

const state::VisitDescription& find_visit(const state::WorldDescription& world, const std::string& name) {
  const auto it = std::ranges::find_if(world.visits, [&](const auto& visit) { return visit.name == name; });
  if (it == world.visits.end()) throw std::runtime_error(world.id + " has no visit '" + name + "'");
  return *it;
}

/// One who holds a device.
class DevicePerson final : public Person {
 public:
  DevicePerson(const state::WorldDescription& description, const state::VisitDescription& visit,
               const PlayOptions& options)
      : player_(description, visit, visitor::fitted(options.player, options.device)),
        device_(haptic::make_virtual_device(options.device, player_.intent().X_WH.p)),
        loop_(value_or_throw(haptic::HapticLoop::create(client_, *device_, haptic::RenderMode::local))),
        X_WB_(description.bodies.size()) {
    device_->intend(player_.intent());
  }

  void act(bool sets_out, state::TickInputs& inputs) override {
    if (sets_out) {
      player_.advance(kTickSeconds, X_WB_, visitor::sense_hand(*device_, *loop_));
      device_->intend(player_.intent());
    }
    now_ += kTickPeriod;
    loop_->tick(now_, kTickPeriod);
    state::UserInput& user = inputs.users[0];
    user.present = true;
    user.fresh = true;
    user.sample = {client_.hand, client_.session(), client_.sent_sequence(), 0};
  }

  void see(const state::WorldState& state) override {
    // The loop takes it in the next tick: a network of one millisecond.
    client_.answer_with(state.users[0].output, now_);
    if (client_.sent_sequence() % transport::WorldPort::kTicksPerFrame == 1) {
      std::ranges::transform(state.bodies, X_WB_.begin(), [](const auto& body) { return body.X_WB; });
    }
  }

  [[nodiscard]] bool finished() const override { return player_.finished(); }
  [[nodiscard]] std::span<const visitor::MoveResult> results() const override { return player_.results(); }
  [[nodiscard]] haptic::LoopStats stats() const override { return loop_->stats(); }

 private:
  visitor::VisitPlayer player_;
  ScriptedClient client_;
  std::unique_ptr<haptic::SimulatedDevice> device_;
  std::unique_ptr<haptic::HapticLoop> loop_;
  TimePoint now_{std::chrono::hours(1)};  // of the loop, whose time is the world's
  std::vector<Pose> X_WB_;                // as last seen
};

/// One visitor in one world.
class Play {
 public:
  Play(std::shared_ptr<const state::WorldDescription> description, const world::WorldConfig& config,
       const std::string& visit, const PlayOptions& options)
      : description_(std::move(description)),
        visit_(find_visit(*description_, visit)),
        options_(options),
        world_(value_or_throw(world::World::create(description_, config))),
        person_(options.make_person ? options.make_person(*description_, visit_)
                                    : std::make_unique<DevicePerson>(*description_, visit_, options)) {}

  PlayedVisit run() {
    state::TickInputs start;
    start.commands[0] = {1, state::CommandKind::start_activity, static_cast<std::uint32_t>(visit_.activity.index())};
    start.command_count = 1;
    tick(start, false);
    for (std::uint64_t i = 0; i < kReactionTicks; ++i)
      tick({}, false);
    std::uint64_t idle = 0;
    while (!person_->finished() || (!done() && static_cast<double>(idle) * kTickSeconds < options_.patience_s)) {
      if (person_->finished()) ++idle;
      tick({}, true);
    }
    return report();
  }

 private:
  [[nodiscard]] bool done() const { return world_->state.progress.done; }

  void tick(state::TickInputs inputs, bool sets_out) {
    person_->act(sets_out, inputs);
    if (options_.record) options_.record(inputs);
    const TimePoint began = clock_.now();
    world::step(*world_, inputs, publisher_, timer_);
    took_.record(clock_.now() - began);
    person_->see(world_->state);
    note_steps();
    if (options_.watch) options_.watch(world_->state);
  }

  void note_steps() {
    for (const state::Event& event : world_->state.event_span()) {
      if (event.kind != state::EventKind::step_started && event.kind != state::EventKind::activity_done) continue;
      if (!report_.steps.empty()) end_step();
      if (event.kind == state::EventKind::activity_done) continue;
      report_.steps.push_back({description_->steps[event.subject].name, 0, false});
      step_tick_ = event.tick;
    }
  }

  void end_step() {
    PlayedStep& step = report_.steps.back();
    step.seconds = static_cast<double>(world_->state.tick - step_tick_) * kTickSeconds;
    const state::StepDescription& described = description_->steps[description_->find_step(step.name).index()];
    // Half a tick of slack, as the rules have.
    step.done = described.timeout_s <= 0 || step.seconds + 0.5 * kTickSeconds < described.timeout_s;
  }

  PlayedVisit report() {
    const state::WorldState& state = world_->state;
    report_.done = done();
    if (!report_.done && state.progress.step)
      report_.stopped_at = description_->steps[state.progress.step.index()].name;
    report_.moves.assign(person_->results().begin(), person_->results().end());
    for (std::size_t i = 0; i < state.quantities.size(); ++i)
      report_.quantities[description_->quantities[i].name] = state.quantities[i];
    report_.seconds = static_cast<double>(state.tick) * kTickSeconds;
    const haptic::LoopStats loop = person_->stats();
    report_.warm_share =
        static_cast<double>(loop.warm_ticks) / static_cast<double>(std::max<std::uint64_t>(loop.ticks, 1));
    report_.state_hash = state::state_hash(state);
    report_.tick_us_median = 1e6 * to_seconds(took_.quantile(0.5));
    return report_;
  }

  std::shared_ptr<const state::WorldDescription> description_;
  const state::VisitDescription& visit_;
  const PlayOptions& options_;
  std::unique_ptr<world::World> world_;
  std::unique_ptr<Person> person_;
  SystemClock clock_;
  world::PhaseTimer timer_{clock_};
  world::NoPublisher publisher_;
  realtime::LatencyHistogram took_;
  std::uint64_t step_tick_ = 0;
  PlayedVisit report_;
};

AgentId agent_or_throw(const state::WorldDescription& world, const std::string& name) {
  const AgentId id = world.find_agent(name);
  if (!id) throw std::runtime_error(world.id + " has no agent '" + name + "'");
  return id;
}

}  // namespace

Exhibit::Exhibit(const std::string& name) {
  app::Settings settings;
  settings.scenarios = {mechane::test::source_folder().string() + "/scenarios/" + name + "/" + name + ".x3d"};
  const auto store = value_or_throw(app::ScenarioStore::load(settings));
  description_ = store.first();
  config_ = store.world_config();
}

Exhibit::Exhibit(std::shared_ptr<const state::WorldDescription> description, world::WorldConfig config)
    : description_(std::move(description)), config_(std::move(config)) {}

PlayedVisit Exhibit::play(const std::string& visit, const PlayOptions& options) const {
  auto description = std::make_shared<state::WorldDescription>(*description_);
  if (options.change) options.change(*description);
  return Play(std::move(description), config_, visit, options).run();
}

PlayedVisit Exhibit::play_changed(const std::string& visit,
                                  std::function<void(state::WorldDescription&)> change) const {
  PlayOptions options;
  options.change = std::move(change);
  return play(visit, options);
}

PlayedVisit Exhibit::play_with_glove(const std::string& visit) const {
  PlayOptions options;
  options.device.hand = client::HandKind::glove;
  return play(visit, options);
}

double Exhibit::value(const state::WorldState& state, const std::string& quantity) const {
  return state.quantities.at(description_->find_quantity(quantity).index());
}

void switch_off(state::WorldDescription& world, const std::string& agent) {
  const AgentId id = agent_or_throw(world, agent);
  for (state::StepDescription& step : world.steps)
    step.disable.push_back(id);
}

void set_parameter(state::WorldDescription& world, const std::string& component, const std::string& parameter,
                   const state::Parameter& value) {
  for (auto* components : {&world.agents, &world.machines}) {
    for (state::ComponentDescription& candidate : *components) {
      if (candidate.name != component) continue;
      candidate.parameters[parameter] = value;
      return;
    }
  }
  throw std::runtime_error(world.id + " has no agent or machine '" + component + "'");
}

void take_away(state::WorldDescription& world, const std::string& body) {
  const BodyId id = world.find_body(body);
  if (!id) throw std::runtime_error(world.id + " has no body '" + body + "'");
  state::BodyDescription& gone = world.bodies[id.index()];
  const Pose X_WGone{gone.X_WB.p - Vec3(0, kUnderTheFloorM, 0), gone.X_WB.R};
  gone.object = nullptr;
  gone.visible = false;
  gone.graspable = false;
  gone.collides = false;
  for (state::StepDescription& step : world.steps) {
    std::erase_if(step.bodies, [&](const auto& change) { return change.body == id; });
    step.bodies.push_back({id, false, false, false, X_WGone});
  }
}

void lose(state::WorldDescription& world, const std::string& part, const std::vector<std::string>& joints_and_ties) {
  take_away(world, part);
  for (const std::string& agent : joints_and_ties)
    switch_off(world, agent);
}

std::ostream& operator<<(std::ostream& out, const PlayedVisit& visit) {
  out << (visit.done ? "done" : "stopped at '" + visit.stopped_at + "'") << " after " << visit.seconds << " s";
  for (const PlayedStep& step : visit.steps)
    out << "\n  step " << step.name << ": " << (step.done ? std::to_string(step.seconds) + " s" : "not done");
  for (const auto& move : visit.moves)
    out << "\n  " << move.name << ": " << move.seconds << " s" << (move.ok ? "" : ", went wrong");
  for (const auto& [name, value] : visit.quantities)
    out << "\n  " << name << " = " << value;
  return out << "\n  force lowered to spare the motors " << 100 * visit.warm_share << " % of the time\n  median tick "
             << visit.tick_us_median << " us\n";
}

}  // namespace mechane::test
