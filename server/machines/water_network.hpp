// What others need of machine.water_network before it is made: the values of its parts.
#pragma once

#include <vector>

#include "server/machines/registry.hpp"

namespace mechane::machines {

/// The values of a component of the type machine.water_network, as it is written: checked or not.
[[nodiscard]] std::vector<OwnValue> network_values(const state::ComponentDescription& component);

}  // namespace mechane::machines
