#include "server/agents/registry.hpp"

#include <array>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

std::array<const AgentKind*, 5> kinds() {
  return {&hinge_kind(), &snap_kind(), &grasp_kind(), &placed_kind(), &turned_kind()};
}

}  // namespace

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = state::types_of(kinds());
  return kTypes;
}

const AgentKind* find_kind(std::string_view type) {
  return state::find_kind_in(kinds(), type);
}

}  // namespace mechane::agents
