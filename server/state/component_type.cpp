#include "server/state/component_type.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/base/assert.hpp"

namespace mechane::state {
namespace {

const ParameterType* find_type(const ComponentType& type, std::string_view name) {
  const auto it =
      std::find_if(type.parameters.begin(), type.parameters.end(), [&](const auto& p) { return p.name == name; });
  return it == type.parameters.end() ? nullptr : &*it;
}

std::string_view kind_name(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::number:
      return "one number";
    case ParameterKind::numbers:
      return "numbers";
    case ParameterKind::text:
      return "one text";
    case ParameterKind::texts:
      return "texts";
    case ParameterKind::boolean:
      return "true or false";
  }
  return "";
}

std::string names_of(const ComponentType& type) {
  std::string list;
  for (const ParameterType& p : type.parameters)
    list += (list.empty() ? "" : ", ") + std::string(p.name);
  return list;
}

template <class Items>
std::string names_of_items(const Items& items) {
  std::string list;
  for (const auto& item : items)
    list += (list.empty() ? "" : ", ") + item.name;
  return list;
}

Expected<void> check_numbers(const ParameterType& type, const std::vector<double>& values, const Place& where) {
  const std::size_t wanted = type.kind == ParameterKind::number ? 1 : type.count;
  if (wanted != 0 && values.size() != wanted)
    return fail(ErrorCode::invalid_value, fmt::format("{} has {} numbers", type.name, values.size()), where,
                fmt::format("write {}", wanted));
  for (const double value : values) {
    if (!std::isfinite(value))
      return fail(ErrorCode::invalid_value, fmt::format("{} is not a finite number", type.name), where,
                  "write a number");
    if (value < type.min || value > type.max)
      return fail(ErrorCode::invalid_value, fmt::format("{} is {} {}", type.name, value, type.unit), where,
                  fmt::format("write a value from {} to {}", type.min, type.max));
  }
  return {};
}

Expected<void> check_reference(const ParameterType& type, const std::string& text, const Place& where,
                               const WorldDescription& world) {
  const auto unknown = [&](std::string_view kind, const std::string& known) {
    return fail(ErrorCode::unknown_name,
                fmt::format("{} names the {} '{}', which is not in this world", type.name, kind, text), where,
                known.empty() ? fmt::format("this world has no {}: add one", kind) : "name one of: " + known);
  };
  switch (type.reference) {
    case Reference::none:
    case Reference::expression:  // its machine reads it
      break;
    case Reference::body:
      if (!world.find_body(text)) return unknown("body", names_of_items(world.bodies));
      break;
    case Reference::joint:
      if (!world.find_joint(text)) return unknown("joint", names_of_items(world.joints));
      break;
    case Reference::agent:
      if (!world.find_agent(text)) return unknown("agent", names_of_items(world.agents));
      break;
    case Reference::activity:
      if (!world.find_activity(text)) return unknown("activity", names_of_items(world.activities));
      break;
    case Reference::quantity:
      if (!world.find_quantity(text)) return unknown("quantity", names_of_items(world.quantities));
      break;
    case Reference::machine:
      if (!world.find_machine(text)) return unknown("machine", names_of_items(world.machines));
      break;
  }
  return {};
}

Expected<void> check_value(const ParameterType& type, const Parameter& value, const Place& where,
                           const WorldDescription& world) {
  const auto wrong_kind = [&] {
    return fail(ErrorCode::invalid_value, fmt::format("{} is of the wrong kind", type.name), where,
                fmt::format("write {}", kind_name(type.kind)));
  };
  switch (type.kind) {
    case ParameterKind::boolean:
      if (!std::holds_alternative<bool>(value)) return wrong_kind();
      return {};
    case ParameterKind::number:
    case ParameterKind::numbers:
      if (!std::holds_alternative<std::vector<double>>(value)) return wrong_kind();
      return check_numbers(type, std::get<std::vector<double>>(value), where);
    case ParameterKind::text:
    case ParameterKind::texts:
      break;
  }
  if (!std::holds_alternative<std::vector<std::string>>(value)) return wrong_kind();
  const auto& texts = std::get<std::vector<std::string>>(value);
  if (type.kind == ParameterKind::text && texts.size() != 1)
    return fail(ErrorCode::invalid_value, fmt::format("{} has {} texts", type.name, texts.size()), where, "write one");
  for (const std::string& text : texts) {
    if (auto good = check_reference(type, text, where, world); !good) return good;
  }
  return {};
}

}  // namespace

Place parameter_place(const ComponentDescription& component, std::string_view parameter) {
  const auto written = component.parameter_lines.find(std::string(parameter));
  const int line = written == component.parameter_lines.end() ? component.line : written->second;
  return {fmt::format("line {}, {} {}", line, component.type, component.name), line};
}

Expected<Parameters> Parameters::check(const ComponentType& type, const ComponentDescription& component,
                                       const WorldDescription& description) {
  for (const auto& [name, value] : component.parameters) {
    const Place where = parameter_place(component, name);
    const ParameterType* known = find_type(type, name);
    if (known == nullptr && type.parameters.empty())
      return fail(ErrorCode::unknown_name, fmt::format("{} takes no parameters, but '{}' is given", type.name, name),
                  where, "remove it");
    if (known == nullptr)
      return fail(ErrorCode::unknown_name, fmt::format("{} has no parameter '{}'", type.name, name), where,
                  fmt::format("use one of: {}", names_of(type)));
    if (auto good = check_value(*known, value, where, description); !good) return tl::unexpected(good.error());
  }
  for (const ParameterType& p : type.parameters) {
    if (p.required && !component.parameters.contains(std::string(p.name)))
      return fail(ErrorCode::missing, fmt::format("the parameter '{}' is missing", p.name),
                  parameter_place(component, p.name),
                  fmt::format("add it: {}{}{}", p.summary, p.unit.empty() ? "" : ", in ", p.unit));
  }
  Parameters out;
  out.type_ = &type;
  out.component_ = &component;
  out.description_ = &description;
  return out;
}

bool Parameters::given(std::string_view name) const {
  return component_->parameters.contains(std::string(name));
}

double Parameters::number(std::string_view name) const {
  const std::vector<double> values = numbers(name);
  MECHANE_ASSERT(values.size() == 1);
  return values.front();
}

bool Parameters::boolean(std::string_view name) const {
  const ParameterType* type = find_type(*type_, name);
  MECHANE_ASSERT(type != nullptr && type->kind == ParameterKind::boolean);
  const auto it = component_->parameters.find(std::string(name));
  return it == component_->parameters.end() ? type->default_value != 0 : std::get<bool>(it->second);
}

std::vector<double> Parameters::numbers(std::string_view name) const {
  const ParameterType* type = find_type(*type_, name);
  MECHANE_ASSERT(type != nullptr && (type->kind == ParameterKind::number || type->kind == ParameterKind::numbers));
  const auto it = component_->parameters.find(std::string(name));
  if (it != component_->parameters.end()) return std::get<std::vector<double>>(it->second);
  return std::vector<double>(type->kind == ParameterKind::number ? 1 : type->count, type->default_value);
}

std::string Parameters::text(std::string_view name) const {
  const std::vector<std::string> values = texts(name);
  return values.empty() ? std::string() : values.front();
}

std::vector<std::string> Parameters::texts(std::string_view name) const {
  const ParameterType* type = find_type(*type_, name);
  MECHANE_ASSERT(type != nullptr && (type->kind == ParameterKind::text || type->kind == ParameterKind::texts));
  const auto it = component_->parameters.find(std::string(name));
  if (it == component_->parameters.end()) return {};
  return std::get<std::vector<std::string>>(it->second);
}

BodyId Parameters::body(std::string_view name) const {
  return description_->find_body(text(name));
}
JointId Parameters::joint(std::string_view name) const {
  return description_->find_joint(text(name));
}
AgentId Parameters::agent(std::string_view name) const {
  return description_->find_agent(text(name));
}

}  // namespace mechane::state
