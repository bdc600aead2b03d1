#include "server/agents/agent.hpp"

namespace mechane::agents {

Expected<void> Agent::link(const state::MemoryLayout& /*layout*/) {
  return {};
}

bool Agent::click(state::WorldState& /*state*/, BodyId /*body*/) const noexcept {
  return false;
}

void let_go(state::WorldState& state, std::size_t user) noexcept {
  state::Grasp& grasp = state.users[user].grasp;
  if (!grasp.active) return;
  state.emit(state::EventKind::released, static_cast<std::uint32_t>(user),
             static_cast<std::uint32_t>(grasp.body.index()));
  grasp = {};
}

}  // namespace mechane::agents
