// The types of machines that a scenario can name.
#pragma once

#include <span>

#include "server/state/component_type.hpp"

namespace mechane::machines {

/// Every type, by name. Any thread.
[[nodiscard]] std::span<const state::ComponentType> registry();

}  // namespace mechane::machines
