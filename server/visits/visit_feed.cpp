#include "server/visits/visit_feed.hpp"

#include <algorithm>

namespace mechane::visits {
namespace {

using state::EventKind;

/// False for kinds that no visit record needs, or that come too often.
bool is_noted(EventKind kind) noexcept {
  switch (kind) {
    case EventKind::none:
    case EventKind::input_stale:
    case EventKind::input_back:
    case EventKind::turned:
    case EventKind::command_refused:
    case EventKind::dwelt:
    case EventKind::idled:
      return false;
    default:
      return true;
  }
}

bool is_tied(const state::Coupling& coupling, std::uint32_t body) noexcept {
  const auto is_it = [body](BodyId id) { return id && id.index() == body; };
  if (!coupling.enabled) return false;
  if (coupling.kind == state::CouplingKind::fixed) return is_it(coupling.body1) || is_it(coupling.body2);
  if (coupling.kind != state::CouplingKind::rope) return false;
  return std::any_of(coupling.nodes.begin(), coupling.nodes.begin() + coupling.node_count,
                     [&](const state::RopeNode& node) { return is_it(node.body); });
}

/// Whether another hand, a joint, a tie or a rope holds the body, so that it does not fall when a hand opens.
bool is_held(const state::WorldDescription& description, const state::WorldState& state, std::uint32_t body) noexcept {
  const auto holds = [body](const state::UserState& user) { return user.present && user.holds(BodyId(body)); };
  if (std::ranges::any_of(state.users, holds)) return true;
  for (std::size_t j = 0; j < description.joints.size(); ++j) {
    const state::JointDescription& joint = description.joints[j];
    if (!state.joints[j].enabled) continue;
    if ((joint.body1 && joint.body1.index() == body) || (joint.body2 && joint.body2.index() == body)) return true;
  }
  return std::ranges::any_of(state.couplings, [body](const state::Coupling& c) { return is_tied(c, body); });
}

/// Whether the visitor opened the hand. Where it jumped or vanished, the device let go.
bool has_opened(const state::WorldDescription& description, const state::WorldState& state,
                const state::Event& event) noexcept {
  if (event.subject >= state.users.size()) return false;
  const state::UserState& user = state.users[event.subject];
  return user.present && !user.jumped && !is_held(description, state, event.object);
}

state::CommandKind kind_of(const state::TickInputs& inputs, const state::Event& done) noexcept {
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(inputs.command_count, state::kMaxCommandsPerTick); ++i) {
    if (static_cast<double>(inputs.commands[i].id) == done.value) return inputs.commands[i].kind;
  }
  return state::CommandKind::none;
}

/// In a running world only a command begins an activity, and one person does not send two in one tick.
state::CommandKind kind_of_start(const state::TickInputs& inputs) noexcept {
  for (std::uint32_t i = 0; i < std::min<std::uint32_t>(inputs.command_count, state::kMaxCommandsPerTick); ++i) {
    if (inputs.commands[i].kind == state::CommandKind::restart_activity) return inputs.commands[i].kind;
  }
  return state::CommandKind::start_activity;
}

}  // namespace

void VisitFeed::push(const state::WorldDescription& description, const state::WorldState& state,
                     const state::TickInputs& inputs) noexcept {
  for (const state::Event& event : state.event_span()) {
    if (!is_noted(event.kind)) continue;
    VisitNote note;
    note.event = event;
    if (event.kind == EventKind::command_done) note.command = kind_of(inputs, event);
    if (event.kind == EventKind::activity_started) note.command = kind_of_start(inputs);
    if (event.kind == EventKind::released) note.opened_hand = has_opened(description, state, event);
    if (!notes_.push(note)) lost_.fetch_add(1, std::memory_order_relaxed);
  }
  tick_.store(state.tick, std::memory_order_release);
}

}  // namespace mechane::visits
