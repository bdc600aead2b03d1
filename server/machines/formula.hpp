// What others need of machine.formula before it is made: the values that its author named.
#pragma once

#include <vector>

#include "server/machines/registry.hpp"

namespace mechane::machines {

/// The values with a unit, of a component of the type machine.formula, as they are written: checked or not.
[[nodiscard]] std::vector<OwnValue> formula_values(const state::ComponentDescription& component);

}  // namespace mechane::machines
