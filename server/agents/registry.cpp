#include "server/agents/registry.hpp"

#include <array>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

std::array<const AgentKind*, 5> kinds() {
  return {&hinge_kind(), &snap_kind(), &grasp_kind(), &placed_kind(), &turned_kind()};
}

std::vector<state::ComponentType> collect_types() {
  std::vector<state::ComponentType> types;
  for (const AgentKind* kind : kinds())
    types.push_back(kind->type);
  return types;
}

}  // namespace

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = collect_types();
  return kTypes;
}

const AgentKind* find_kind(std::string_view type) {
  for (const AgentKind* kind : kinds()) {
    if (kind->type.name == type) return kind;
  }
  return nullptr;
}

}  // namespace mechane::agents
