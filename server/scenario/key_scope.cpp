#include "server/scenario/key_scope.hpp"

#include <algorithm>

#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/values.hpp"

namespace mechane::scenario {
namespace {

using Holds = Scope::Holds;

Scope of_table(const Table& table) {
  return {Holds::keys, &table, Names::nothing, {}, nullptr};
}

/// A component's type, as its key `type` says.
const state::ComponentType* type_in(const Document& document, NodeId set, std::span<const state::ComponentType> types) {
  const NodeId element = set ? find_child(document, set, "type") : NodeId::none();
  const std::string* value = element ? document[element].attribute("value") : nullptr;
  const auto names = value != nullptr ? parse_strings(*value) : Value<std::vector<std::string>>();
  if (!names || names->size() != 1) return nullptr;
  const auto it = std::find_if(types.begin(), types.end(), [&](const auto& t) { return t.name == names->front(); });
  return it == types.end() ? nullptr : &*it;
}

Names naming_of(std::string_view key) {
  if (key == "quantities") return Names::quantity;
  if (key == "activities") return Names::activity;
  if (key == "steps") return Names::step;
  if (key == "agents" || key == "machines") return Names::agent;
  return Names::nothing;
}

Scope of_key(const Key& key) {
  if (key.kind != ValueKind::set) return {};
  if (!key.free_names) return key.inner == nullptr ? Scope{} : of_table(*key.inner);
  Scope scope{Holds::named, key.inner, naming_of(key.name), {}, nullptr};
  if (key.inner == nullptr) {
    scope.holds = Holds::components;
    scope.types = key.name == "agents" ? agents::registry() : machines::registry();
  }
  return scope;
}

ValueKind kind_of(const state::ParameterType& parameter) {
  switch (parameter.kind) {
    case state::ParameterKind::boolean:
      return ValueKind::boolean;
    case state::ParameterKind::text:
      return ValueKind::string;
    case state::ParameterKind::texts:
      return ValueKind::strings;
    case state::ParameterKind::number:
    case state::ParameterKind::numbers:
      break;
  }
  return ValueKind::number;
}

Names names_of(state::Reference reference) {
  switch (reference) {
    case state::Reference::body:
      return Names::body;
    case state::Reference::joint:
      return Names::joint;
    case state::Reference::agent:
      return Names::agent;
    case state::Reference::activity:
      return Names::activity;
    default:
      return Names::nothing;
  }
}

}  // namespace

Scope scope_of_set(const Document& document, NodeId id) {
  const std::string name = name_of(document, id);
  if (name == "mechane:scenario") return of_table(scenario_table());
  if (name == "mechane:body") return of_table(body_table());
  if (name == "mechane:haptic") return of_table(haptic_table());
  if (name != "mechane:agent") return {};
  return {Holds::parameters, nullptr, Names::nothing, {}, type_in(document, id, agents::registry())};
}

Scope scope_of_child(const Document& document, const Scope& scope, std::string_view name, NodeId child) {
  switch (scope.holds) {
    case Holds::keys: {
      const Key* key = scope.table->find(name);
      return key == nullptr ? Scope{} : of_key(*key);
    }
    case Holds::named:
      return of_table(*scope.table);
    case Holds::components:
      return {Holds::parameters, nullptr, Names::nothing, scope.types, type_in(document, child, scope.types)};
    case Holds::parameters:
    case Holds::nothing:
      break;
  }
  return {};
}

Leaf leaf_of(const Scope& scope, std::string_view name) {
  if (scope.holds == Holds::keys) {
    const Key* key = scope.table->find(name);
    return key == nullptr || key->kind == ValueKind::set ? Leaf{} : Leaf{true, key->kind, key->names};
  }
  // A quantity may be a string alone: its source.
  if (scope.holds == Holds::named && scope.naming == Names::quantity) return {true, ValueKind::string, Names::source};
  if (scope.holds != Holds::parameters) return {};
  if (name == "type") return {true, ValueKind::string, Names::nothing};
  if (scope.type == nullptr) return {};
  for (const state::ParameterType& parameter : scope.type->parameters) {
    if (parameter.name == name) return {true, kind_of(parameter), names_of(parameter.reference)};
  }
  return {};
}

std::vector<std::string> names_in(const Scope& scope) {
  std::vector<std::string> names;
  if (scope.holds == Holds::keys) {
    for (const Key& key : scope.table->keys)
      names.emplace_back(key.name);
  } else if (scope.holds == Holds::parameters) {
    names.emplace_back("type");
    if (scope.type == nullptr) return names;
    for (const state::ParameterType& parameter : scope.type->parameters)
      names.emplace_back(parameter.name);
  }
  return names;
}

std::string name_of(const Document& document, NodeId metadata) {
  const std::string* name = document[document.resolve(metadata)].attribute("name");
  return name != nullptr ? *name : std::string();
}

NodeId find_child(const Document& document, NodeId set, std::string_view name) {
  for (const NodeId child : document.child_elements(document.resolve(set))) {
    if (document[child].name.starts_with("Metadata") && document.container_field(child, "value") == "value" &&
        name_of(document, child) == name)
      return document.resolve(child);
  }
  return NodeId::none();
}

NodeId find_set(const Document& document, NodeId owner, std::string_view name) {
  const auto is_named = [&](NodeId id) { return document[id].name == "MetadataSet" && name_of(document, id) == name; };
  NodeId found;
  for (const NodeId child : document.child_elements(owner)) {
    if (!document[child].name.starts_with("Metadata") || document.container_field(child, "metadata") != "metadata")
      continue;
    if (is_named(child)) found = child;
    for (const NodeId inner : document.child_elements(document.resolve(child))) {
      if (!found && is_named(inner)) found = inner;
    }
  }
  return found ? document.resolve(found) : found;
}

}  // namespace mechane::scenario
