// Goals that cannot be reached: each rule is compared with the range of its quantity.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The values that a quantity can have, in its own unit, and the parameter or stops that limit them.
struct Range {
  double min = -kInfinity;
  double max = kInfinity;
  std::string from;
};

const state::ValueType* find_value(const state::ComponentType& type, std::string_view name) {
  const auto it = std::ranges::find(type.values, name, &state::ValueType::name);
  return it == type.values.end() ? nullptr : &*it;
}

void narrow(const std::vector<state::ComponentDescription>& table,
            const state::ComponentType* (*find)(std::string_view), const std::string& name, const std::string& value,
            const std::string& unit, Range& range) {
  for (const state::ComponentDescription& component : table) {
    const state::ComponentType* type = component.name == name ? find(component.type) : nullptr;
    const state::ValueType* stated = type != nullptr ? find_value(*type, value) : nullptr;
    if (stated == nullptr) continue;
    const double factor = state::unit_factor(value, unit);
    range.min = factor * stated->min;
    range.max = factor * stated->max;
    if (stated->max_parameter.empty()) continue;
    range.max = std::min(range.max, factor * parameter_of(component, *type, stated->max_parameter));
    range.from = fmt::format("{} of {}", stated->max_parameter, name);
  }
}

/// Narrows the range to a joint's stops.
void narrow_to_stops(const state::WorldDescription& world, const std::string& name, const std::string& value,
                     const std::string& unit, Range& range) {
  const JointId id = world.find_joint(name);
  if (!id || (value != "angle" && value != "position" && value != "turns")) return;
  const state::JointDescription& joint = world.joints[id.index()];
  if (joint.min_position > joint.max_position || joint.kind == state::JointKind::ball) return;
  const double factor = value == "turns" ? 1 / (2 * kPi) : state::unit_factor(value, unit);
  range = {factor * joint.min_position, factor * joint.max_position, "the stops of " + name};
}

Range range_of(const state::WorldDescription& world, const state::QuantityDescription& quantity) {
  const std::size_t dot = quantity.source.find('.');
  const std::string name = quantity.source.substr(0, dot);
  const std::string value = dot == std::string::npos ? "" : quantity.source.substr(dot + 1);
  Range range;
  narrow(world.agents, find_agent_type, name, value, quantity.unit, range);
  narrow(world.machines, find_machine_type, name, value, quantity.unit, range);
  narrow_to_stops(world, name, value, quantity.unit, range);
  return range;
}

bool can_hold(const state::RuleDescription& rule, const Range& range) {
  switch (rule.comparison) {
    case state::Comparison::less:
      return rule.value > range.min;
    case state::Comparison::equal:
      return rule.value + rule.tolerance >= range.min && rule.value - rule.tolerance <= range.max;
    case state::Comparison::greater:
      return rule.value < range.max;
  }
  return true;
}

std::string in_words(const Range& range, const std::string& unit) {
  const std::string of = unit.empty() ? "" : " " + unit;
  if (range.min > -kInfinity && range.max < kInfinity)
    return fmt::format("goes from {} to {}{}", range.min, range.max, of);
  return range.max < kInfinity ? fmt::format("is at most {}{}", range.max, of)
                               : fmt::format("is at least {}{}", range.min, of);
}

}  // namespace

double parameter_of(const state::ComponentDescription& component, const state::ComponentType& type,
                    std::string_view name) {
  const auto it = component.parameters.find(std::string(name));
  if (it != component.parameters.end()) {
    const auto* numbers = std::get_if<std::vector<double>>(&it->second);
    return numbers != nullptr && numbers->size() == 1 ? numbers->front() : kInfinity;
  }
  const auto known = std::find_if(type.parameters.begin(), type.parameters.end(),
                                  [&](const state::ParameterType& p) { return p.name == name; });
  return known == type.parameters.end() || known->required ? kInfinity : known->default_value;
}

void check_goals(Compilation& c) {
  for (const WrittenRule& written : c.rules) {
    const state::QuantityDescription& quantity = c.world.quantities[written.rule.quantity.index()];
    const Range range = range_of(c.world, quantity);
    if (can_hold(written.rule, range)) continue;
    const std::string from = range.from.empty() ? "" : fmt::format(" ({})", range.from);
    c.problems.error(ErrorCode::conflict, written.line, written.where,
                     fmt::format("the rule can never hold: '{}' {}{}, and the rule asks for {} {}", quantity.name,
                                 in_words(range, quantity.unit), from,
                                 written.rule.comparison == state::Comparison::less      ? "less than"
                                 : written.rule.comparison == state::Comparison::greater ? "more than"
                                                                                         : "exactly",
                                 written.rule.value),
                     "write a value that the quantity can reach");
  }
}

}  // namespace mechane::scenario
