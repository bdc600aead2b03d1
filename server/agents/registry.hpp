// The types of agents that a scenario can name.
#pragma once

#include <span>

#include "server/state/component_type.hpp"

namespace mechane::agents {

/// Every type, by name: geometry.* set constraints, simulation.* interpret what happens. Any thread.
[[nodiscard]] std::span<const state::ComponentType> registry();

}  // namespace mechane::agents
