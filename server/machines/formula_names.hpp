// Where a formula names things of the scenario, so that tools can find and rename them without reading the formula.
#pragma once

#include <string_view>
#include <vector>

#include "server/state/description.hpp"

namespace mechane::machines {

struct FormulaName {
  std::size_t begin = 0;  ///< in the text, bytes
  std::size_t length = 0;
  bool quantity = false;  ///< the NAME of "quantity.NAME"; else a joint's, before its dot
};

/// Of any text, right or wrong, in the order in which they stand. Any thread.
[[nodiscard]] std::vector<FormulaName> names_in_formula(std::string_view text);

/// The quantities that a component's formulas name, each once; none where its type takes no formulas.
[[nodiscard]] std::vector<std::string> quantities_in_formulas(const state::ComponentDescription& component);

}  // namespace mechane::machines
