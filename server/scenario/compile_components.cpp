// Agents and machines: those of the scenario's tree, and those of `mechane:agent` on joints and bodies.
#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "server/agents/registry.hpp"
#include "server/base/suggestion.hpp"
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

/// A kind of component: its word for people, and its types.
struct Registry {
  std::string_view word;
  std::span<const ComponentType> types;
};

state::Parameter to_parameter(const x3d::Metadata& value) {
  if (value.kind == x3d::MetadataKind::booleans) return value.booleans.size() == 1 && value.booleans.front();
  if (value.kind == x3d::MetadataKind::strings) return value.strings;
  return value.numbers;
}

/// The fault of decimal commas in a parameter that takes a fixed count of numbers; none where there are no commas.
std::optional<x3d::BadValue> comma_in(const ParameterType& type, const x3d::Metadata& value) {
  const std::size_t wanted = type.kind == state::ParameterKind::number    ? 1
                             : type.kind == state::ParameterKind::numbers ? type.count
                                                                          : 0;
  return wanted == 0 ? std::nullopt : x3d::comma_fault(value.commas, value.numbers.size(), wanted);
}

/// Puts the copies' names for COIN-* in a list of bodies.
void name_copies(const Compilation& c, state::Parameter& list) {
  auto* names = std::get_if<std::vector<std::string>>(&list);
  if (names == nullptr) return;
  std::vector<std::string> all;
  for (const std::string& name : *names) {
    const std::vector<std::string> copies = all_copies(c, name);
    all.insert(all.end(), copies.begin(), copies.end());
  }
  *names = std::move(all);
}

void read_parameter(Compilation& c, const x3d::Metadata& value, const ComponentType& type, const std::string& where,
                    state::ComponentDescription& out) {
  const auto known = std::ranges::find(type.parameters, value.name, &ParameterType::name);
  if (known == type.parameters.end()) {
    const std::vector<std::string> names = names_of_all(type.parameters);
    c.problems.unknown(value.line, where, fmt::format("{} has no parameter '{}'", out.type, value.name), value.name,
                       names);
    c.misspelt_parameters.emplace(out.name, nearest(value.name, names));
  } else if (value.kind == x3d::MetadataKind::unreadable) {
    c.misspelt_parameters.emplace(out.name, value.name);
  } else if (value.kind == x3d::MetadataKind::set ||
             (value.kind == x3d::MetadataKind::booleans && value.booleans.size() != 1)) {
    c.problems.error(ErrorCode::invalid_value, value.line, where,
                     fmt::format("the parameter '{}' must be one value", value.name), std::string(known->summary));
  } else if (const auto comma = comma_in(*known, value)) {
    c.problems.error(ErrorCode::invalid_value, value.line, where, fmt::format("{}: {}", value.name, comma->what),
                     comma->remedy);
    c.misspelt_parameters.emplace(out.name, value.name);
  } else {
    out.parameters[value.name] = to_parameter(value);
    if (known->reference == state::Reference::body && known->kind == state::ParameterKind::texts)
      name_copies(c, out.parameters[value.name]);
    out.parameter_lines[value.name] = value.line;
  }
}

/// Reads type and parameters, and checks the names of the parameters. check_components() checks values and references, once all names are
/// known. A component with an unknown type is kept, so that no reference to it is a second error.
void read_component(Compilation& c, const x3d::Metadata& set, const Registry& registry,
                    state::ComponentDescription& out) {
  const std::string where = fmt::format("{} {}", registry.word, out.name);
  out.line = set.line;
  const x3d::Metadata* type_name = set.find("type");
  if (type_name != nullptr && type_name->kind == x3d::MetadataKind::unreadable) return;
  if (type_name == nullptr || type_name->kind != x3d::MetadataKind::strings || type_name->strings.size() != 1) {
    c.problems.error(ErrorCode::missing, set.line, where, "the key 'type' is missing",
                     fmt::format("write one of: {}", fmt::join(names_of_all(registry.types), ", ")));
    return;
  }
  out.type = type_name->strings.front();
  const ComponentType* type = find_type(registry.types, out.type);
  if (type == nullptr) {
    c.problems.error(ErrorCode::unknown_name, type_name->line, where,
                     fmt::format("there is no {} type '{}'", registry.word, out.type),
                     suggest(out.type, names_of_all(registry.types), "remove it"));
    return;
  }
  for (const x3d::Metadata& child : set.children) {
    if (child.name != "type") read_parameter(c, child, *type, where, out);
  }
}

void add_component(Compilation& c, std::vector<state::ComponentDescription>& table, const x3d::Metadata& set,
                   const Registry& registry, state::ComponentDescription component) {
  if (c.world.find_agent(component.name) || c.world.find_machine(component.name)) {
    c.problems.error(ErrorCode::duplicate, set.line, fmt::format("{} {}", registry.word, component.name),
                     "another agent or machine has this name", "rename one of them");
    return;
  }
  read_component(c, set, registry, component);
  table.push_back(std::move(component));
}

/// An agent on a joint or a body acts on that one: its name fills the type's first parameter that names a joint or a body.
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
  for (const x3d::NodeId id : c.document.elements(node_type)) {
    const auto set = x3d::read_metadata(c.document, id, "mechane:agent", c.problems);
    if (!set) continue;
    Attributes attributes(c.document, id, c.problems);
    const std::string name = attributes.text("DEF");
    if (name.empty()) {
      attributes.error(ErrorCode::missing, "an element with an agent has no DEF",
                       "write a DEF: the agent gets the same name");
      continue;
    }
    if (c.copies.contains(name)) {
      attributes.error(
          ErrorCode::conflict, fmt::format("{} is {} bodies, and this agent acts on one", name, c.copies.at(name)),
          fmt::format("put it into the scenario's agents, and name its body there, like {}", copy_name(name, 0)));
      continue;
    }
    const std::size_t before = c.world.agents.size();
    add_component(c, c.world.agents, *set, registry, {name, {}, {}, 0});
    if (c.world.agents.size() > before) imply_subject(name, kind, c.world.agents.back());
  }
}

void compile_tree(Compilation& c, std::string_view key, const Registry& registry,
                  std::vector<state::ComponentDescription>& table) {
  const x3d::Metadata* tree = tree_set(c, key);
  if (tree == nullptr) return;
  for (const x3d::Metadata& set : tree->children) {
    if (set.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, set.line, std::string(key), fmt::format("'{}' is not a set", set.name),
                       "write a MetadataSet with a type and its parameters");
      continue;
    }
    add_component(c, table, set, registry, {set.name, {}, {}, 0});
  }
}

/// A body that snaps into another one touches it all over, so the two never collide.
void add_mates(Compilation& c, const state::ComponentDescription& component, const state::Parameters& parameters) {
  if (component.type != "geometry.snap" || !parameters.given("into")) return;
  const BodyId object = parameters.body("object");
  const BodyId into = parameters.body("into");
  if (object != into) c.world.mates.push_back({object, into});
}

/// All names of the kind that a parameter refers to; none where it refers to nothing.
std::optional<std::vector<std::string>> named_by(const state::WorldDescription& world, state::Reference kind) {
  switch (kind) {
    case state::Reference::none:
    case state::Reference::expression:
      break;
    case state::Reference::body:
      return names_of(world.bodies);
    case state::Reference::joint:
      return names_of(world.joints);
    case state::Reference::agent:
      return names_of(world.agents);
    case state::Reference::activity:
      return names_of(world.activities);
    case state::Reference::quantity:
      return names_of(world.quantities);
    case state::Reference::machine:
      return names_of(world.machines);
  }
  return std::nullopt;
}

std::string_view reference_word(state::Reference kind) {
  static constexpr std::pair<state::Reference, std::string_view> kWords[] = {
      {state::Reference::body, "body"},         {state::Reference::joint, "joint"},
      {state::Reference::agent, "agent"},       {state::Reference::activity, "activity"},
      {state::Reference::quantity, "quantity"}, {state::Reference::machine, "machine"}};
  const auto found = std::ranges::find(kWords, kind, &std::pair<state::Reference, std::string_view>::first);
  return found == std::end(kWords) ? "" : found->second;
}

/// Reports names that do not exist, each at its own line. True where all exist.
bool names_are_known(Compilation& c, const state::ComponentDescription& component, const ComponentType& type,
                     const std::string& where) {
  bool good = true;
  for (const ParameterType& parameter : type.parameters) {
    const auto known = named_by(c.world, parameter.reference);
    const auto value = component.parameters.find(std::string(parameter.name));
    if (!known || value == component.parameters.end()) continue;
    const auto* names = std::get_if<std::vector<std::string>>(&value->second);
    for (const std::string& name : names != nullptr ? *names : std::vector<std::string>()) {
      if (std::ranges::find(*known, name) != known->end()) continue;
      good = false;
      const int line = state::parameter_place(component, value->first).line;
      if (parameter.reference == state::Reference::body && report_copies(c, {where, line}, name)) continue;
      const std::string_view word = reference_word(parameter.reference);
      c.problems.error(ErrorCode::unknown_name, line, where,
                       fmt::format("{}: no {} is called '{}'", parameter.name, word, name),
                       suggest(name, *known, fmt::format("the scenario has no {}: add one", word)));
    }
  }
  return good;
}

/// Whether the first required parameter that is missing was written, but misspelt or malformed, which has been reported.
bool missing_is_reported(const Compilation& c, const state::ComponentDescription& component,
                         const ComponentType& type) {
  const auto missing = std::ranges::find_if(type.parameters, [&](const ParameterType& p) {
    return p.required && !component.parameters.contains(std::string(p.name));
  });
  return missing != type.parameters.end() &&
         c.misspelt_parameters.contains({component.name, std::string(missing->name)});
}

void check_one(Compilation& c, const state::ComponentDescription& component, const ComponentType* type,
               std::string_view word) {
  if (type == nullptr) return;
  const std::string where = fmt::format("{} {}", word, component.name);
  if (!names_are_known(c, component, *type, where)) return;
  const auto parameters = state::Parameters::check(*type, component, c.world);
  if (parameters) return add_mates(c, component, *parameters);
  const Error& error = parameters.error();
  if (error.code == ErrorCode::missing && missing_is_reported(c, component, *type)) return;
  c.problems.error(error.code, error.line, where, error.what, error.remedy);
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

void check_agents(Compilation& c) {
  for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
    const auto checked = agents::check(c.world, AgentId(i));
    if (checked) continue;
    const Error& error = checked.error();
    c.problems.error(error.code, error.line, "agent " + c.world.agents[i].name, error.what, error.remedy);
  }
}

void check_machines(Compilation& c) {
  for (const auto& [machine, error] : machines::check(c.world)) {
    c.problems.error(error.code, error.line, "machine " + c.world.machines[machine.index()].name, error.what,
                     error.remedy);
  }
}

}  // namespace mechane::scenario
