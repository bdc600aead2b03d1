#include "server/transport/world_endpoints.hpp"

#include <algorithm>
#include <chrono>

#include "server/state/rope_shape.hpp"
#include "server/transport/names.hpp"
#include "server/transport/presentation.hpp"
#include "server/transport/wire_texts.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {
namespace {

// Commands for the tick have the same numbers in the state and on the wire; the other kinds are for the main thread.
template <state::CommandKind ours, proto::CommandKind wire>
constexpr bool kSame = static_cast<int>(ours) == static_cast<int>(wire);
static_assert(kSame<state::CommandKind::none, mechane_command_none>);
static_assert(kSame<state::CommandKind::start_activity, mechane_command_start_activity>);
static_assert(kSame<state::CommandKind::restart_activity, mechane_command_restart_activity>);
static_assert(kSame<state::CommandKind::next_step, mechane_command_next_step>);
static_assert(kSame<state::CommandKind::click, mechane_command_click>);

std::uint64_t now_ns() {
  return to_ns(std::chrono::steady_clock::now());
}

const state::Texts& texts_of(const state::StepDescription* step, const std::string& which) {
  static const state::Texts none;
  if (step == nullptr) return none;
  const auto it = step->texts.find(which);
  return it == step->texts.end() ? none : it->second;
}

template <class Item, class IdType>
const Item* item_at(const std::vector<Item>& items, IdType id) {
  return id && id.index() < items.size() ? &items[id.index()] : nullptr;
}

/// The quantities that the step's first trigger waits for to rise or fall. Other triggers lead to side steps, or back.
std::vector<proto::WireQuantityGoal> goals_of(const state::StepDescription* step) {
  std::vector<proto::WireQuantityGoal> goals;
  const auto add = [&](const auto& rule) {
    const auto quantity = static_cast<std::uint32_t>(rule.quantity.index());
    const bool known = std::ranges::find(goals, quantity, &proto::WireQuantityGoal::quantity) != goals.end();
    if (known || rule.comparison == state::Comparison::equal) return;
    goals.push_back({quantity, rule.value, rule.comparison == state::Comparison::less});
  };
  if (step == nullptr || step->triggers.empty()) return goals;
  add(step->triggers.front());
  for (const state::RuleDescription& rule : step->triggers.front().more)
    add(rule);
  return goals;
}

proto::WireQuantity wire_quantity(const state::QuantityDescription& quantity, std::vector<proto::WireText>& label) {
  proto::WireQuantity wire{};
  wire.name = proto::look_into(quantity.name);
  wire.unit = proto::look_into(quantity.unit);
  proto::look_into(wire.label, label);
  wire.ranged = quantity.range.has_value();
  if (quantity.range) {
    wire.least = quantity.range->least;
    wire.greatest = quantity.range->greatest;
  }
  return wire;
}

bool same_progress(const SceneSnapshot& a, const SceneSnapshot& b) {
  const state::Progress& p = a.progress;
  const state::Progress& q = b.progress;
  return p.activity == q.activity && p.step == q.step && p.done == q.done && p.steps_done == q.steps_done &&
         p.hint_shown == q.hint_shown && a.agent_enabled == b.agent_enabled;
}

bool same_pose(const Pose& a, const Pose& b) {
  return a.p == b.p && a.R.coeffs() == b.R.coeffs();
}

}  // namespace

WorldEndpoints::WorldEndpoints(WorldPort& port, RejectCounters& rejects, const ScenarioNames& scenarios)
    : port_(port), rejects_(rejects), scenarios_(scenarios) {
  const auto& bodies = port.description().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].fixed) movable_.push_back(static_cast<std::uint32_t>(i));
  }
  bodies_.resize(movable_.size());
  hands_.reserve(hand::kMaxUsers);
}

Expected<std::unique_ptr<WorldEndpoints>> WorldEndpoints::create(const proto::Participant& participant, WorldPort& port,
                                                                 RejectCounters& rejects,
                                                                 const ScenarioNames& scenarios) {
  std::unique_ptr<WorldEndpoints> made(new WorldEndpoints(port, rejects, scenarios));
  const std::string partition = proto::world_partition(port.world());
  const auto open = [&](auto& endpoint, auto created) -> std::optional<Error> {
    if (!created) return created.error();
    endpoint = std::move(*created);
    return std::nullopt;
  };
  WorldEndpoints* const raw = made.get();
  std::optional<Error> fault = open(made->frames_, proto::Writer<proto::SceneFrame>::create(participant, partition));
  if (!fault) fault = open(made->objects_, proto::Writer<proto::SceneObject>::create(participant, partition));
  if (!fault) fault = open(made->status_, proto::Writer<proto::WorldStatus>::create(participant, partition));
  if (!fault)
    fault = open(made->presentation_, proto::Writer<proto::WorldPresentation>::create(participant, partition));
  if (!fault) fault = open(made->events_, proto::Writer<proto::Event>::create(participant, partition));
  if (!fault) {
    fault = open(made->commands_, proto::Reader<proto::Command>::create(
                                      participant, partition,
                                      [raw](proto::ReaderView<proto::Command> view) { raw->take_commands(view); }));
  }
  if (fault) return tl::unexpected<Error>(*fault);
  return made;
}

void WorldEndpoints::take_commands(proto::ReaderView<proto::Command> view) {
  view.take_each([this](const proto::Command& wire, const proto::SampleInfo& info) {
    if (!info.valid) return;
    if (wire.protocol != proto::kProtocol) return rejects_.add(Reject::wrong_protocol);
    if (!is_new(wire.session, wire.id)) return;
    switch (wire.kind) {
      case mechane_command_open:
        return take_request(proto::string_of(wire.argument), wire.id);
      case mechane_command_answer:
        return take_answer(proto::string_of(wire.argument), wire.id);
      case mechane_command_language:
        return take_language(proto::string_of(wire.argument), wire.id);
      case mechane_command_start_activity:
      case mechane_command_restart_activity:
      case mechane_command_next_step:
      case mechane_command_click:
        return take_for_tick(wire);
      case mechane_command_none:
        break;
    }
    refuse(wire.id);
  });
}

void WorldEndpoints::take_for_tick(const proto::Command& wire) {
  state::Command command;
  command.id = wire.id;
  command.kind = static_cast<state::CommandKind>(wire.kind);
  if (command.kind == state::CommandKind::start_activity) {
    const ActivityId activity = port_.description().find_activity(proto::string_of(wire.argument));
    if (!activity) return refuse(wire.id);
    command.argument = static_cast<std::uint32_t>(activity.index());
  } else if (command.kind == state::CommandKind::click) {
    const BodyId body = port_.description().find_body(proto::string_of(wire.argument));
    if (!body) return refuse(wire.id);
    command.argument = static_cast<std::uint32_t>(body.index());
  }
  if (!port_.offer_command(command)) refuse(wire.id);
}

void WorldEndpoints::take_request(const std::string& scenario, std::uint64_t id) {
  const auto found = scenarios_.find(scenario);
  if (!found || !port_.offer_request(*found)) refuse(id);
}

void WorldEndpoints::take_answer(const std::string& argument, std::uint64_t id) {
  const auto answer = state::parse_visit_answer(argument, port_.description());
  if (!answer || !port_.offer_answer(*answer)) return refuse(id);
  reply(id, state::EventKind::command_done);
}

void WorldEndpoints::take_language(const std::string& language, std::uint64_t id) {
  const auto& known = port_.description().languages;
  const auto found = std::find(known.begin(), known.end(), language);
  if (found == known.end() || !port_.offer_language(static_cast<std::uint32_t>(found - known.begin())))
    return refuse(id);
  reply(id, state::EventKind::command_done);
}

bool WorldEndpoints::is_new(std::uint64_t session, std::uint64_t id) {
  const auto known = std::find_if(heard_.begin(), heard_.end(), [&](const Heard& h) { return h.session == session; });
  if (known != heard_.end()) {
    if (id <= known->id) return false;
    known->id = id;
    return true;
  }
  heard_[next_heard_++ % heard_.size()] = {session, id};
  return true;
}

void WorldEndpoints::refuse(std::uint64_t id) {
  reply(id, state::EventKind::command_refused);
}

void WorldEndpoints::reply(std::uint64_t id, state::EventKind kind) {
  // The ring is full where somebody sends commands faster than they can be answered: these get no answer.
  if (!replies_.push({id, kind})) rejects_.add(Reject::bad_value);
}

void WorldEndpoints::write_manifest() {
  const state::WorldDescription& world = port_.description();
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const state::BodyDescription& body = world.bodies[i];
    const std::string parent;  // a body's pose is in W
    proto::SceneObject o{};
    proto::set_text(o.world, port_.world());
    o.object = static_cast<std::uint32_t>(i);
    o.protocol = proto::kProtocol;
    o.seq = i + 1;
    o.sent_ns = now_ns();
    o.objects_total = static_cast<std::uint32_t>(world.bodies.size());
    o.name = proto::look_into(body.name);
    o.mesh_uri = proto::look_into(body.mesh.uri);
    o.mesh_hash = proto::look_into(body.mesh.content_hash);
    o.mesh_node = proto::look_into(body.mesh.node);
    o.parent = proto::look_into(parent);
    proto::set_pose(o.X_WB, body.X_WB);
    o.movable = !body.fixed;
    o.visible = body.visible;
    o.stiffness_n_per_m = static_cast<float>(body.haptic.stiffness_n_per_m);
    o.damping_ns_per_m = static_cast<float>(body.haptic.damping_ns_per_m);
    o.static_friction = static_cast<float>(body.haptic.static_friction);
    o.dynamic_friction = static_cast<float>(body.haptic.dynamic_friction);
    std::vector<proto::WireText> title = wire_texts(body.title);
    proto::look_into(o.title, title);
    count(objects_.write(o));
  }
  count(presentation_.write(Presentation(port_.world(), world).wire()));
}

void WorldEndpoints::write() {
  state::Event event;
  if (const SceneSnapshot* snapshot = port_.take_snapshot()) {
    const bool status_changed = !last_ || !same_progress(*last_, *snapshot);
    if (status_changed) write_status(*snapshot);
    // While nothing moves, every second frame is left out: 30 a second are enough to show that the world is running.
    skipped_last_ = !status_changed && !skipped_last_ && !moved(*snapshot);
    if (!skipped_last_) {
      write_frame(*snapshot);
      last_ = *snapshot;
    }
  }
  while (port_.take_event(event))
    write_event(event);
  Reply reply;
  while (replies_.pop(reply)) {
    state::Event answer;
    answer.tick = last_ ? last_->tick : 0;
    answer.kind = reply.kind;
    answer.value = static_cast<double>(reply.id);
    write_event(answer);
  }
}

bool WorldEndpoints::moved(const SceneSnapshot& snapshot) const {
  if (!last_ || last_->visible != snapshot.visible || last_->quantities != snapshot.quantities) return true;
  for (const std::uint32_t i : movable_) {
    if (!same_pose(last_->bodies[i], snapshot.bodies[i])) return true;
  }
  return std::any_of(snapshot.hands.begin(), snapshot.hands.end(), [](const HandSnapshot& h) { return h.present; });
}

void WorldEndpoints::write_frame(const SceneSnapshot& snapshot) {
  for (std::size_t i = 0; i < movable_.size(); ++i) {
    bodies_[i].object = movable_[i];
    proto::set_pose(bodies_[i].X_WB, snapshot.bodies[movable_[i]]);
  }
  hands_.clear();
  for (std::size_t i = 0; i < snapshot.hands.size(); ++i) {
    const HandSnapshot& hand = snapshot.hands[i];
    if (!hand.present) continue;
    const std::size_t segments = hand.kind == hand::HandKind::glove ? hand::kHandSegments : 1;
    for (std::size_t s = 0; s < segments; ++s)
      proto::set_pose(segments_[i][s], hand.X_WS[s]);
    proto::WireHandPose& wire = hands_.emplace_back();
    proto::set_text(wire.kiosk, hand.name.kiosk.data());
    wire.user = hand.name.user;
    wire.session = hand.name.session;
    wire.kind = static_cast<std::uint8_t>(hand.kind);
    wire.stale = hand.stale ? 1 : 0;
    wire.holding = hand.holding ? 1 : 0;
    wire.X_WS._buffer = segments_[i].data();
    wire.X_WS._length = wire.X_WS._maximum = static_cast<std::uint32_t>(segments);
    proto::set_vec3(wire.f_W, hand.f_W);
  }
  set_ropes(snapshot);
  SceneSnapshot copy = snapshot;  // wire sequences need buffers that are not const, though nobody writes to them
  proto::SceneFrame frame{};
  proto::set_text(frame.world, port_.world());
  frame.protocol = proto::kProtocol;
  frame.seq = ++frame_sequence_;
  frame.sent_ns = snapshot.sampled_ns;
  frame.tick = snapshot.tick;
  proto::look_into(frame.bodies, bodies_);
  proto::look_into(frame.visible, copy.visible);
  proto::look_into(frame.quantities, copy.quantities);
  proto::look_into(frame.hands, hands_);
  proto::look_into(frame.ropes, ropes_);
  count(frames_.write(frame));
}

void WorldEndpoints::set_ropes(const SceneSnapshot& snapshot) {
  const Vec3 g_W = port_.description().gravity_W;
  const Vec3 down_W = g_W.norm() > 0 ? Vec3(g_W.normalized()) : Vec3(0, -1, 0);
  ropes_.resize(snapshot.rope_count);
  rope_points_.resize(snapshot.rope_count);
  for (std::size_t i = 0; i < snapshot.rope_count; ++i) {
    const std::vector<Vec3> shape = state::rope_shape(snapshot.ropes[i], snapshot.bodies, down_W);
    rope_points_[i].clear();
    for (const Vec3& p_W : shape) {
      for (int k = 0; k < 3; ++k)
        rope_points_[i].push_back(static_cast<float>(p_W[k]));
    }
    ropes_[i].diameter_m = static_cast<float>(snapshot.ropes[i].diameter_m);
    proto::look_into(ropes_[i].p_W, rope_points_[i]);
  }
}

void WorldEndpoints::write_status(const SceneSnapshot& snapshot) {
  const state::WorldDescription& world = port_.description();
  const state::Progress& progress = snapshot.progress;
  const auto* activity = item_at(world.activities, progress.activity);
  const auto* step = item_at(world.steps, progress.step);
  const std::string none;
  std::vector<char*> agents;
  for (std::size_t i = 0; i < world.agents.size(); ++i) {
    if (snapshot.agent_enabled[i] != 0) agents.push_back(proto::look_into(world.agents[i].name));
  }
  std::vector<char*> activities;
  for (const auto& a : world.activities)
    activities.push_back(proto::look_into(a.name));
  std::vector<std::vector<proto::WireText>> labels;
  for (const auto& q : world.quantities)
    labels.push_back(wire_texts(q.label));
  std::vector<proto::WireQuantity> quantities;
  for (std::size_t i = 0; i < labels.size(); ++i)
    quantities.push_back(wire_quantity(world.quantities[i], labels[i]));
  std::vector<proto::WireQuantityGoal> goals = goals_of(step);
  auto title = wire_texts(world.title);
  auto caption = wire_texts(texts_of(step, "caption"));
  auto hint = wire_texts(texts_of(step, "hint"));
  auto narration = wire_texts(texts_of(step, "narration"));
  auto audio = wire_texts(texts_of(step, "audio"));

  proto::WorldStatus status{};
  proto::set_text(status.world, port_.world());
  status.protocol = proto::kProtocol;
  status.seq = ++status_sequence_;
  status.sent_ns = now_ns();
  status.scenario = proto::look_into(world.id);
  status.scenario_hash = proto::look_into(world.content_hash);
  status.scenario_folder = proto::look_into(world.folder);
  status.activity = proto::look_into(activity != nullptr ? activity->name : none);
  status.step = proto::look_into(step != nullptr ? step->name : none);
  status.steps_done = progress.steps_done;
  // A visitor takes one of the steps that lead to another scenario, and leaves: they do not count.
  status.steps_total =
      static_cast<std::uint32_t>(std::count_if(world.steps.begin(), world.steps.end(), [&](const auto& s) {
        return s.activity == progress.activity && s.opens.empty();
      }));
  status.done = progress.done;
  status.hint = progress.hint_shown;
  proto::look_into(status.enabled_agents, agents);
  proto::look_into(status.quantities, quantities);
  proto::look_into(status.goals, goals);
  proto::look_into(status.title, title);
  proto::look_into(status.caption, caption);
  proto::look_into(status.hint_text, hint);
  proto::look_into(status.narration, narration);
  proto::look_into(status.audio, audio);
  status.detail = proto::look_into(step != nullptr ? step->detail : none);
  proto::look_into(status.activities, activities);
  count(status_.write(status));
}

void WorldEndpoints::write_event(const state::Event& event) {
  static const std::array<HandSnapshot, hand::kMaxUsers> nobody{};
  const EventNames names = names_of(port_.description(), event, last_ ? last_->hands : nobody);
  proto::Event wire{};
  proto::set_text(wire.scope, proto::world_partition(port_.world()));
  wire.protocol = proto::kProtocol;
  wire.seq = ++event_sequence_;
  wire.sent_ns = now_ns();
  wire.tick = event.tick;
  proto::set_text(wire.kind, names.kind);
  wire.subject = proto::look_into(names.subject);
  wire.object = proto::look_into(names.object);
  wire.value = event.value;
  count(events_.write(wire));
}

}  // namespace mechane::transport
