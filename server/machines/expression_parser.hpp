// From the text of a formula to its program, with every unit checked.
//
//   condition  := condition and|or condition | not condition | sum <|<=|>|>= sum
//   sum        := product +|- product ...        product := factor *|/ factor ...        factor := -factor | item^WHOLE_NUMBER
//   item       := NUMBER [UNIT] | (condition) | FUNCTION(condition, ...) | pi | VALUE | JOINT.angle|position|rate | quantity.NAME
//
// A unit follows its number: blanks between its words, and none at its slashes: "9.81 m/s^2", "3 N m/rad". A slash with blanks divides.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/machines/expression.hpp"
#include "server/machines/formula_tokens.hpp"

namespace mechane::machines {

inline constexpr std::size_t kMostFormulaLetters = 1000;

/// A value of a formula machine: "level = volume / area in cm".
struct FormulaValue {
  std::string name;
  std::optional<Unit> unit;  ///< that it is shown in; none: for other formulas only
  std::string unit_text;
  std::size_t slot = 0;  ///< of its SI value, in the machine's memory
  Dimension dimension;   ///< once its formula has been read; before that the unit's
  bool read = false;
};

/// What a formula may name, and where it keeps its sums.
struct FormulaScope {
  const state::WorldDescription& world;
  const std::vector<FormulaValue>& values;
  std::vector<double>& memory;  ///< the machine's own, as it is at the start: integrals and sums add theirs
};

/// What a formula's result must be: a condition never is.
/// Errors: invalid_value, unknown_name, conflict (units), too_large; each with the place in the text and what to write.
[[nodiscard]] Expected<Expression> parse_expression(const FormulaText& text, const FormulaScope& scope);

/// Whether the result of an expression can stand for this: it has the unit, or it is a bare 0.
[[nodiscard]] bool fits(const Expression& expression, const Dimension& wanted);

}  // namespace mechane::machines
