// Agents and machines: from the scenario's tree, and from `mechane:agent` on joints and bodies.
#include <algorithm>

#include <fmt/format.h>

#include "server/agents/registry.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using state::ComponentType;
using state::ParameterType;

const ComponentType* find_type(std::span<const ComponentType> types, std::string_view name) {
  const auto it = std::find_if(types.begin(), types.end(), [&](const ComponentType& t) { return t.name == name; });
  return it == types.end() ? nullptr : &*it;
}

std::vector<std::string> names_of_all(auto items) {
  std::vector<std::string> names;
  for (const auto& item : items)
    names.emplace_back(item.name);
  return names;
}

/// What kind of component a place holds: its word for people, and its types.
struct Registry {
  std::string_view word;
  std::span<const ComponentType> types;
};

state::Parameter to_parameter(const Metadata& value) {
  if (value.kind == MetadataKind::booleans) return value.booleans.size() == 1 && value.booleans.front();
  if (value.kind == MetadataKind::strings) return value.strings;
  return value.numbers;
}

/// Reads type and parameters. Names and kinds of parameters are held against the type here, where each has its line; values and
/// references by check_components, when all names are known.
bool read_component(Compilation& c, const Metadata& set, const Registry& registry, state::ComponentDescription& out) {
  const std::string where = fmt::format("{} {}", registry.word, out.name);
  out.line = set.line;
  const Metadata* type_name = set.find("type");
  if (type_name == nullptr || type_name->kind != MetadataKind::strings || type_name->strings.size() != 1) {
    c.problems.error(set.line, where, "the key 'type' is missing",
                     fmt::format("write one of: {}", fmt::join(names_of_all(registry.types), ", ")));
    return false;
  }
  out.type = type_name->strings.front();
  const ComponentType* type = find_type(registry.types, out.type);
  if (type == nullptr) {
    c.problems.error(type_name->line, where, fmt::format("no {} is of the type '{}'", registry.word, out.type),
                     suggest(out.type, names_of_all(registry.types), "remove it"));
    return false;
  }
  for (const Metadata& child : set.children) {
    if (child.name == "type") continue;
    const auto known = std::find_if(type->parameters.begin(), type->parameters.end(),
                                    [&](const ParameterType& p) { return p.name == child.name; });
    if (known == type->parameters.end()) {
      c.problems.unknown(child.line, where, fmt::format("{} has no parameter '{}'", out.type, child.name), child.name,
                         names_of_all(type->parameters));
    } else if (child.kind == MetadataKind::set ||
               (child.kind == MetadataKind::booleans && child.booleans.size() != 1)) {
      c.problems.error(child.line, where, fmt::format("the parameter '{}' is not one value", child.name),
                       std::string(known->summary));
    } else {
      out.parameters[child.name] = to_parameter(child);
    }
  }
  return true;
}

void add_component(Compilation& c, std::vector<state::ComponentDescription>& table, const Metadata& set,
                   const Registry& registry, state::ComponentDescription component) {
  if (c.world.find_agent(component.name) || c.world.find_machine(component.name)) {
    c.problems.error(set.line, fmt::format("{} {}", registry.word, component.name),
                     "another agent or machine has this name", "rename one of them");
    return;
  }
  if (read_component(c, set, registry, component)) table.push_back(std::move(component));
}

/// An agent on a joint or a body means that one: it fills the type's first parameter that names such a thing.
void imply_subject(const std::string& name, state::Reference kind, state::ComponentDescription& component) {
  const ComponentType* type = find_agent_type(component.type);
  if (type == nullptr) return;
  for (const ParameterType& p : type->parameters) {
    if (p.reference != kind) continue;
    component.parameters.try_emplace(std::string(p.name), std::vector<std::string>{name});
    return;
  }
}

void compile_node_agents(Compilation& c, std::string_view node_type, state::Reference kind) {
  const Registry registry{"agent", agents::registry()};
  for (const NodeId id : c.document.elements(node_type)) {
    const auto set = read_metadata(c.document, id, "mechane:agent", c.problems);
    if (!set) continue;
    Attributes attributes(c.document, id, c.problems);
    const std::string name = attributes.text("DEF");
    if (name.empty()) {
      attributes.error("an element with an agent has no DEF", "give it a name: the agent is called by it");
      continue;
    }
    const std::size_t before = c.world.agents.size();
    add_component(c, c.world.agents, *set, registry, {name, {}, {}, 0});
    if (c.world.agents.size() > before) imply_subject(name, kind, c.world.agents.back());
  }
}

void compile_tree(Compilation& c, std::string_view key, const Registry& registry,
                  std::vector<state::ComponentDescription>& table) {
  const Metadata* tree = tree_set(c, key);
  if (tree == nullptr) return;
  for (const Metadata& set : tree->children) {
    if (set.kind != MetadataKind::set) {
      c.problems.error(set.line, std::string(key), fmt::format("'{}' is not a set", set.name),
                       "write a MetadataSet with a type and its parameters");
      continue;
    }
    add_component(c, table, set, registry, {set.name, {}, {}, 0});
  }
}

/// What snaps into another body sits in it: the two never collide.
void add_mates(Compilation& c, const state::ComponentDescription& component, const state::Parameters& parameters) {
  if (component.type != "geometry.snap" || !parameters.given("into")) return;
  const BodyId object = parameters.body("object");
  const BodyId into = parameters.body("into");
  if (object != into) c.world.mates.push_back({object, into});
}

void check_one(Compilation& c, const state::ComponentDescription& component, const ComponentType* type,
               std::string_view word) {
  if (type == nullptr) return;
  const auto parameters = state::Parameters::check(*type, component, c.world);
  if (!parameters) {
    c.problems.error(component.line, fmt::format("{} {}", word, component.name), parameters.error().what,
                     parameters.error().remedy);
    return;
  }
  add_mates(c, component, *parameters);
}

}  // namespace

const ComponentType* find_agent_type(std::string_view name) {
  return find_type(agents::registry(), name);
}
const ComponentType* find_machine_type(std::string_view name) {
  return find_type(machines::registry(), name);
}

void compile_components(Compilation& c) {
  for (const char* type : {"SingleAxisHingeJoint", "SliderJoint", "BallJoint"})
    compile_node_agents(c, type, state::Reference::joint);
  compile_node_agents(c, "RigidBody", state::Reference::body);
  compile_tree(c, "agents", {"agent", agents::registry()}, c.world.agents);
  compile_tree(c, "machines", {"machine", machines::registry()}, c.world.machines);
}

void check_components(Compilation& c) {
  for (const auto& agent : c.world.agents)
    check_one(c, agent, find_agent_type(agent.type), "agent");
  for (const auto& machine : c.world.machines)
    check_one(c, machine, find_machine_type(machine.type), "machine");
}

}  // namespace mechane::scenario
