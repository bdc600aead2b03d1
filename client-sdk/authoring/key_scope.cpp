#include "client-sdk/authoring/key_scope.hpp"

#include <algorithm>

#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/values.hpp"

namespace mechane::authoring {
namespace {

using Holds = Scope::Holds;

Scope of_table(const scenario::Table& table) {
  return {Holds::keys, &table, scenario::Names::nothing, {}, nullptr};
}

/// A component's type, by its key `type`.
const state::ComponentType* type_in(const x3d::Document& document, x3d::NodeId set,
                                    std::span<const state::ComponentType> types) {
  const x3d::NodeId element = set ? x3d::find_child(document, set, "type") : x3d::NodeId::none();
  const std::string* value = element ? document[element].attribute("value") : nullptr;
  const auto names = value != nullptr ? x3d::parse_strings(*value) : x3d::Value<std::vector<std::string>>();
  if (!names || names->size() != 1) return nullptr;
  const auto it = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == names->front(); });
  return it == types.end() ? nullptr : &*it;
}

scenario::Names naming_of(std::string_view key) {
  if (key == "quantities") return scenario::Names::quantity;
  if (key == "activities") return scenario::Names::activity;
  if (key == "steps") return scenario::Names::step;
  if (key == "agents" || key == "machines") return scenario::Names::agent;
  return scenario::Names::nothing;
}

Scope of_key(const scenario::Key& key) {
  if (key.kind != scenario::ValueKind::set) return {};
  if (!key.free_names) return key.inner == nullptr ? Scope{} : of_table(*key.inner);
  Scope scope{Holds::named, key.inner, naming_of(key.name), {}, nullptr};
  if (key.inner == nullptr) {
    scope.holds = Holds::components;
    scope.types = key.name == "agents" ? agents::registry() : machines::registry();
  }
  return scope;
}

scenario::ValueKind kind_of(const state::ParameterType& parameter) {
  switch (parameter.kind) {
    case state::ParameterKind::boolean:
      return scenario::ValueKind::boolean;
    case state::ParameterKind::text:
      return scenario::ValueKind::string;
    case state::ParameterKind::texts:
      return scenario::ValueKind::strings;
    case state::ParameterKind::number:
    case state::ParameterKind::numbers:
      break;
  }
  return scenario::ValueKind::number;
}

scenario::Names names_of(state::Reference reference) {
  switch (reference) {
    case state::Reference::body:
      return scenario::Names::body;
    case state::Reference::joint:
      return scenario::Names::joint;
    case state::Reference::agent:
      return scenario::Names::agent;
    case state::Reference::activity:
      return scenario::Names::activity;
    case state::Reference::expression:
      return scenario::Names::formula;
    default:
      return scenario::Names::nothing;
  }
}

}  // namespace

Scope scope_of_set(const x3d::Document& document, x3d::NodeId id) {
  const std::string name = x3d::name_of(document, id);
  if (name == "mechane:scenario") return of_table(scenario::scenario_table());
  if (name == "mechane:body") return of_table(scenario::body_table());
  if (name == "mechane:haptic") return of_table(scenario::haptic_table());
  if (name != "mechane:agent") return {};
  return {Holds::parameters, nullptr, scenario::Names::nothing, {}, type_in(document, id, agents::registry())};
}

Scope scope_of_child(const x3d::Document& document, const Scope& scope, std::string_view name, x3d::NodeId child) {
  switch (scope.holds) {
    case Holds::keys: {
      const scenario::Key* key = scope.table->find(name);
      return key == nullptr ? Scope{} : of_key(*key);
    }
    case Holds::named:
      return of_table(*scope.table);
    case Holds::components:
      return {Holds::parameters, nullptr, scenario::Names::nothing, scope.types, type_in(document, child, scope.types)};
    case Holds::parameters:
    case Holds::nothing:
      break;
  }
  return {};
}

Leaf leaf_of(const Scope& scope, std::string_view name) {
  if (scope.holds == Holds::keys) {
    const scenario::Key* key = scope.table->find(name);
    return key == nullptr || key->kind == scenario::ValueKind::set ? Leaf{} : Leaf{true, key->kind, key->names};
  }
  // A quantity may be written as just a string: its source.
  if (scope.holds == Holds::named && scope.naming == scenario::Names::quantity)
    return {true, scenario::ValueKind::string, scenario::Names::source};
  if (scope.holds != Holds::parameters) return {};
  if (name == "type") return {true, scenario::ValueKind::string, scenario::Names::nothing};
  if (scope.type == nullptr) return {};
  for (const state::ParameterType& parameter : scope.type->parameters) {
    if (parameter.name == name) return {true, kind_of(parameter), names_of(parameter.reference)};
  }
  return {};
}

std::vector<std::string> names_in(const Scope& scope) {
  std::vector<std::string> names;
  if (scope.holds == Holds::keys) {
    for (const scenario::Key& key : scope.table->keys)
      names.emplace_back(key.name);
  } else if (scope.holds == Holds::parameters) {
    names.emplace_back("type");
    if (scope.type == nullptr) return names;
    for (const state::ParameterType& parameter : scope.type->parameters)
      names.emplace_back(parameter.name);
  }
  return names;
}

}  // namespace mechane::authoring
