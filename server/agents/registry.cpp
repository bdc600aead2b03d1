#include "server/agents/registry.hpp"

#include "server/agents/agent.hpp"

namespace mechane::agents {

std::span<const AgentKind* const> kinds() {
  static const AgentKind* const kKinds[] = {&hinge_kind(),   &slider_kind(), &ball_kind(),   &fixed_kind(),
                                            &screw_kind(),   &gear_kind(),   &worm_kind(),   &intermittent_gear_kind(),
                                            &ratchet_kind(), &rope_kind(),   &snap_kind(),   &breakable_kind(),
                                            &grasp_kind(),   &placed_kind(), &turned_kind(), &pulled_kind(),
                                            &pushed_kind(),  &fired_kind(),  &lit_kind(),    &assembled_kind(),
                                            &dwell_kind(),   &point_kind(),  &idle_kind(),   &surface_kind()};
  return kKinds;
}

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = state::types_of(kinds());
  return kTypes;
}

Expected<void> check(const state::WorldDescription& description, AgentId agent) {
  state::MemoryLayout layout;
  const auto made = state::make_component(kinds(), "agent", description, description.agents, agent, layout);
  if (!made) return tl::unexpected(made.error());
  return {};
}

}  // namespace mechane::agents
