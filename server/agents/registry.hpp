// The types of agents that a scenario can name.
#pragma once

#include <span>

#include "server/state/component_type.hpp"

namespace mechane::agents {

/// Every type, by name: geometry.* set constraints, touch.* what is felt, simulation.* interpret what happens. Any thread.
[[nodiscard]] std::span<const state::ComponentType> registry();

/// Makes an agent and throws it away: the errors of AgentSet::create() that have to do with its parameters. Not in the tick.
[[nodiscard]] Expected<void> check(const state::WorldDescription& description, AgentId agent);

}  // namespace mechane::agents
