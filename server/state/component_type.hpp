// What a type of agent or machine asks for and offers: the schema by which a scenario is checked, a studio makes its forms, and
// create() of agents and machines reads parameters.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/description.hpp"

namespace mechane::state {

enum class ParameterKind {
  number,   ///< one number
  numbers,  ///< `count` numbers (0: any count)
  text,     ///< one string
  texts,    ///< any count of strings
  boolean,
};

/// What a text names, so that a checker and an editor can offer the right list. An expression names several things, among other words:
/// joints before a dot, and quantities after "quantity.".
enum class Reference { none, body, joint, agent, activity, quantity, machine, expression };

/// The default_value of a number without a default: where its key is left out, something else counts.
inline constexpr double kNoDefault = std::numeric_limits<double>::quiet_NaN();

struct ParameterType {
  std::string_view name;
  ParameterKind kind = ParameterKind::number;
  std::string_view unit = {};     ///< SI, "" for none
  std::string_view summary = {};  ///< what it does, one line
  bool required = false;
  double default_value = 0;  ///< of a number, and of every one of `numbers`; a boolean: not 0 is true
  double min = -std::numeric_limits<double>::infinity();  ///< of a number, and of every one of `numbers`; inclusive
  double max = std::numeric_limits<double>::infinity();
  std::size_t count = 0;                  ///< of `numbers`
  Reference reference = Reference::none;  ///< of a text and of every one of `texts`
  std::string_view default_text = {};     ///< of numbers without a default of their own: what counts instead, in words

  /// Of numbers: whether leaving the key out means `default_value`. A value outside the limits says that it does not.
  [[nodiscard]] constexpr bool has_default() const { return default_value >= min && default_value <= max; }
};

/// A value that quantities can read as "<COMPONENT>.<name>".
struct ValueType {
  std::string_view name;
  std::string_view unit = {};
  std::string_view summary = {};
  double min = -std::numeric_limits<double>::infinity();  ///< what it can come to
  double max = std::numeric_limits<double>::infinity();
  std::string_view max_parameter = {};  ///< of the same component: the value never exceeds it; in the same unit
};

/// What a quantity's unit makes of a value: an angle in `deg`, a rate in `rpm`; every other is read as it is.
[[nodiscard]] inline double unit_factor(std::string_view value, std::string_view unit) {
  if (value == "rate" && unit == "rpm") return 60 / (2 * kPi);
  if (value == "angle" && unit == "deg") return 180 / kPi;
  return 1;
}

/// A value that is 0 or 1.
[[nodiscard]] constexpr ValueType yes_or_no(std::string_view name, std::string_view summary) {
  return {name, {}, summary, 0, 1, {}};
}

/// A value that is never below zero: a count, a length, a time, what was lifted.
[[nodiscard]] constexpr ValueType amount(std::string_view name, std::string_view unit, std::string_view summary,
                                         std::string_view max_parameter = {}) {
  return {name, unit, summary, 0, std::numeric_limits<double>::infinity(), max_parameter};
}

/// The limit of a place, along each axis: it finds misplaced digits, and keeps sums of squares finite.
inline constexpr double kFarthest_m = 1e4;

/// A parameter of three numbers: a point of a frame, in m.
[[nodiscard]] constexpr ParameterType point(std::string_view name, std::string_view summary, bool required = false) {
  return {.name = name,
          .kind = ParameterKind::numbers,
          .unit = "m",
          .summary = summary,
          .required = required,
          .min = -kFarthest_m,
          .max = kFarthest_m,
          .count = 3};
}

/// A parameter of three numbers: a vector whose length does not matter.
[[nodiscard]] constexpr ParameterType direction(std::string_view name, std::string_view summary,
                                                bool required = false) {
  ParameterType type = point(name, summary, required);
  type.unit = {};
  return type;
}

/// A parameter of one number: a position of a joint, in m, or in rad of a hinge.
[[nodiscard]] constexpr ParameterType joint_position(std::string_view name, std::string_view unit,
                                                     std::string_view summary) {
  return {.name = name,
          .unit = unit,
          .summary = summary,
          .default_value = kNoDefault,
          .min = -kFarthest_m,
          .max = kFarthest_m};
}

struct ComponentType {
  std::string_view name;  ///< "geometry.hinge"
  std::string_view summary;
  std::span<const ParameterType> parameters;
  std::span<const ValueType> values;
};

/// What a room's registry offers of its kinds, each a type and its maker: the types alone. For a static of the registry's.
template <class Kinds>
[[nodiscard]] std::vector<ComponentType> types_of(const Kinds& kinds) {
  std::vector<ComponentType> types;
  types.reserve(std::size(kinds));
  for (const auto* kind : kinds)
    types.push_back(kind->type);
  return types;
}

/// The parameters of one component, already held against its type. Any thread; immutable.
class Parameters {
 public:
  /// Errors name the component, the parameter's line, what is wrong and what to write: unknown_name (a parameter that the type does
  /// not have, a text that names no such body, joint, agent or activity), missing (a required parameter), invalid_value (the wrong
  /// kind or count, a number that is not finite or out of range). The returned object points into its arguments.
  [[nodiscard]] static Expected<Parameters> check(const ComponentType& type, const ComponentDescription& component,
                                                  const WorldDescription& description);

  /// Whether the author wrote it.
  [[nodiscard]] bool given(std::string_view name) const;
  /// The author's value or the type's default. The name and kind must be of the type (our bug otherwise).
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] bool boolean(std::string_view name) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view name) const;
  [[nodiscard]] std::string text(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view name) const;
  /// A text that names a body or joint; none where it was not given.
  [[nodiscard]] BodyId body(std::string_view name) const;
  [[nodiscard]] JointId joint(std::string_view name) const;
  [[nodiscard]] AgentId agent(std::string_view name) const;

 private:
  const ComponentType* type_ = nullptr;
  const ComponentDescription* component_ = nullptr;
  const WorldDescription* description_ = nullptr;
};

/// Where a parameter of a component was written, for an Error: "line 43, geometry.hinge HINGE". The component's own line if the
/// parameter is not written, or empty.
[[nodiscard]] Place parameter_place(const ComponentDescription& component, std::string_view parameter);

}  // namespace mechane::state
