// Quantities: names for the values of components, joints and bodies.
#include <algorithm>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/machines/formula_names.hpp"
#include "server/machines/registry.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

const state::ComponentDescription* find_component(const std::vector<state::ComponentDescription>& table,
                                                  const std::string& name) {
  const auto it = std::find_if(table.begin(), table.end(), [&](const auto& item) { return item.name == name; });
  return it == table.end() ? nullptr : &*it;
}

void add_values(const state::ComponentType* type, std::vector<std::string>& values) {
  if (type == nullptr) return;
  for (const state::ValueType& value : type->values)
    values.emplace_back(value.name);
}

/// Of X3D's nodes that send events, what can be read as numbers. Bodies have names of their own for theirs.
void add_fields(const state::EventNode& node, std::vector<std::string>& values) {
  for (const state::EventField& field : node.fields) {
    if (node.body || !field.sends) continue;
    if (field.start.size() == 1) values.push_back(field.name);
    for (const char* axis : {".x", ".y", ".z"}) {
      if (field.start.size() == 3) values.push_back(field.name + axis);
    }
  }
}

/// The values that may follow the dot; empty where nothing has the name. An agent and its joint may share a name.
std::vector<std::string> values_of(const state::WorldDescription& world, const std::string& name) {
  std::vector<std::string> values;
  if (const auto* agent = find_component(world.agents, name)) add_values(find_agent_type(agent->type), values);
  if (const auto* machine = find_component(world.machines, name)) {
    add_values(find_machine_type(machine->type), values);
    for (const machines::OwnValue& own : machines::own_values(*machine))
      values.push_back(own.name);
  }
  const auto event = std::ranges::find(world.events.nodes, name, &state::EventNode::name);
  if (event != world.events.nodes.end()) add_fields(*event, values);
  if (world.find_joint(name)) values.insert(values.end(), {"position", "angle", "rate", "turns"});
  if (world.find_body(name)) values.insert(values.end(), {"position.x", "position.y", "position.z", "speed"});
  return values;
}

std::vector<std::string> all_sources(const state::WorldDescription& world) {
  std::vector<std::string> names = names_of(world.agents);
  for (const auto& more :
       {names_of(world.machines), names_of(world.joints), names_of(world.bodies), names_of(world.events.nodes)})
    names.insert(names.end(), more.begin(), more.end());
  return names;
}

void check_source(Compilation& c, const std::string& source, int line, const std::string& where) {
  const std::size_t dot = source.find('.');
  const std::string name = source.substr(0, dot);
  const std::string value = dot == std::string::npos ? "" : source.substr(dot + 1);
  const std::vector<std::string> values = values_of(c.world, name);
  const bool has_no_type =
      find_component(c.world.agents, name) != nullptr || find_component(c.world.machines, name) != nullptr;
  if (values.empty() && has_no_type) return;  // its unknown type has been reported
  if (values.empty() && report_copies(c, {where, line}, name)) return;
  if (values.empty()) {
    c.problems.error(ErrorCode::unknown_name, line, where,
                     fmt::format("the source '{}' does not name an agent, machine, joint, body or sensor", source),
                     suggest(name, all_sources(c.world), "add an agent or a machine"));
  } else if (std::find(values.begin(), values.end(), value) == values.end()) {
    c.problems.error(ErrorCode::unknown_name, line, where, fmt::format("'{}' has no value '{}'", name, value),
                     suggest(value, values, ""));
  }
}

const std::vector<std::string>& known_units() {
  static const std::vector<std::string> kKnown = {
      "m",  "cm", "mm", "km", "rad", "deg",  "rpm",  "rad/s", "s",     "min",  "h",  "l",   "l/s",  "l/min",
      "m3", "m2", "kg", "g",  "t",   "N",    "kN",   "N m",   "J",     "kJ",   "W",  "m/s", "m/s2", "degC",
      "K",  "%",  "Pa", "Hz", "",    "kg/s", "m3/s", "1/s",   "1/min", "km/h", "kW", "bar", "turns"};
  return kKnown;
}

bool is_known_unit(const std::string& unit) {
  return std::find(known_units().begin(), known_units().end(), unit) != known_units().end();
}

/// A unit is shown as it is written. rpm and deg are also converted, so a misspelling there would show a wrong number.
void check_unit(Compilation& c, const std::string& unit, int line, const std::string& where) {
  if (is_known_unit(unit)) return;
  c.problems.warning(ErrorCode::unknown_name, line, where,
                     fmt::format("the unit '{}' is not known and is shown as it is", unit),
                     suggest(unit, known_units(),
                             "keep it if visitors know it; only rpm (for rates) and deg (for angles) are converted"));
}

/// The units of one source: its own first, then those that it is converted to.
using Units = std::vector<std::string>;
using OwnValues = std::vector<machines::OwnValue>;

Units units_of(std::string_view value, std::string_view unit) {
  Units units{std::string(unit)};
  if (unit == "rad" && value == "angle") units.emplace_back("deg");
  if (unit == "rad/s" && value == "rate") units.emplace_back("rpm");
  if (unit.empty() && value == "turns") units.emplace_back("turns");
  // Pulled, pushed and fired measure along a slider or about a hinge.
  if (unit == "m" && value == "travel") units.emplace_back("rad");
  return units;
}

Units units_of_joint(const state::JointDescription& joint, std::string_view value) {
  const bool slides = joint.kind == state::JointKind::slider;
  if (value == "turns") return units_of(value, "");
  if (value == "rate") return units_of(value, slides ? "m/s" : "rad/s");
  return units_of(value, slides ? "m" : "rad");
}

/// The units of a source; empty where it does not exist. A component comes before a joint or body of the same name.
Units units_of_source(const state::WorldDescription& world, const std::string& source) {
  const std::size_t dot = std::min(source.find('.'), source.size() - 1);
  const std::string name = source.substr(0, dot), value = source.substr(dot + 1);
  const auto* agent = find_component(world.agents, name);
  const auto* machine = find_component(world.machines, name);
  for (const state::ComponentType* type : {agent != nullptr ? find_agent_type(agent->type) : nullptr,
                                           machine != nullptr ? find_machine_type(machine->type) : nullptr}) {
    if (type == nullptr) continue;
    const auto stated = std::ranges::find(type->values, value, &state::ValueType::name);
    if (stated != type->values.end()) return units_of(value, stated->unit);
  }
  for (const machines::OwnValue& own : machine != nullptr ? machines::own_values(*machine) : OwnValues()) {
    if (own.name == value) return {own.unit};
  }
  if (const JointId joint = world.find_joint(name)) return units_of_joint(world.joints[joint.index()], value);
  if (world.find_body(name)) return units_of(value, value == "speed" ? "m/s" : "m");
  return {};
}

void check_unit_fits(Compilation& c, const state::QuantityDescription& quantity, int line, const std::string& where) {
  if (quantity.unit.empty() || quantity.source.empty() || !is_known_unit(quantity.unit)) return;
  const Units units = units_of_source(c.world, quantity.source);
  if (units.empty() || std::find(units.begin(), units.end(), quantity.unit) != units.end()) return;
  const bool plain = units.front().empty();
  c.problems.warning(
      ErrorCode::conflict, line, where,
      fmt::format("the unit '{}' does not fit '{}', which {}: the number is not converted", quantity.unit,
                  quantity.source, plain ? std::string("has no unit") : fmt::format("is in {}", units.front())),
      plain ? std::string("leave the unit out") : fmt::format("write {}", fmt::join(units, " or ")));
}

/// A range needs an end, the right way round, and a gauge on which it is seen.
void read_range(Compilation& c, const Fields& fields, state::QuantityDescription& quantity) {
  const bool ends = fields.given("greatest");
  if (!ends && !fields.given("least")) return;
  const int line = fields.line("least");
  const state::GaugeRange range{fields.number("least"), fields.number("greatest")};
  if (!ends) {
    c.problems.error(ErrorCode::missing, line, fields.where(), "the range has no end", "add greatest, or remove least");
  } else if (range.least >= range.greatest) {
    c.problems.error(
        ErrorCode::conflict, fields.line("greatest"), fields.where(),
        fmt::format("the range is reversed: its least, {}, is not below its greatest, {}", range.least, range.greatest),
        "exchange them");
  } else {
    quantity.range = range;
    if (!quantity.label.empty() || one_of(quantity.unit, state::gauge_units())) return;
    c.problems.warning(ErrorCode::conflict, fields.line("greatest"), fields.where(),
                       "the range is not seen: displays do not show this quantity",
                       "give it a text with label.LANGUAGE");
  }
}

}  // namespace

void compile_quantities(Compilation& c) {
  const x3d::Metadata* tree = tree_set(c, "quantities");
  if (tree == nullptr) return;
  for (const x3d::Metadata& item : tree->children) {
    const std::string where = "quantity " + item.name;
    state::QuantityDescription quantity;
    quantity.name = item.name;
    int line = item.line;
    if (item.kind == x3d::MetadataKind::strings && item.strings.size() == 1) {
      quantity.source = item.strings.front();
    } else if (item.kind == x3d::MetadataKind::set) {
      const Fields fields(&item, quantity_table(), where, c.problems);
      quantity.source = fields.string("source");
      quantity.unit = fields.string("unit");
      if (fields.has_faults()) c.misspelt_parameters.emplace(quantity.name, "unit");
      check_unit(c, quantity.unit, fields.line("unit"), where);
      check_unit_fits(c, quantity, fields.line("unit"), where);
      quantity.label = read_texts(c, fields.set("text"), where + ", text", "label")["label"];
      read_range(c, fields, quantity);
      line = fields.line("source");
      c.quantity_lines[quantity.name] = item.line;
    } else if (item.kind != x3d::MetadataKind::unreadable) {
      c.problems.error(ErrorCode::invalid_value, item.line, where, "this quantity is neither a source nor a set",
                       "write a MetadataString like \"PUMP.basin_l\"");
    }
    if (!quantity.source.empty()) check_source(c, quantity.source, line, where);
    c.world.quantities.push_back(std::move(quantity));
  }
}

/// A quantity whose unit only labels it, or that has none, would give a formula a number of another unit.
void check_formulas(Compilation& c) {
  for (const state::ComponentDescription& machine : c.world.machines) {
    for (const std::string& name : machines::quantities_in_formulas(machine)) {
      const QuantityId id = c.world.find_quantity(name);
      if (!id) continue;
      const state::QuantityDescription& quantity = c.world.quantities[id.index()];
      const Units units = units_of_source(c.world, quantity.source);
      if (units.empty() || std::ranges::find(units, quantity.unit) != units.end()) continue;
      const std::string in = units.front().empty() ? "a pure number" : "in " + units.front();
      c.problems.error(ErrorCode::conflict, machine.line, "machine " + machine.name,
                       fmt::format("a formula reads the quantity '{}', whose unit is '{}', but '{}' is {}", name,
                                   quantity.unit, quantity.source, in),
                       units.front().empty() ? fmt::format("leave out the unit of '{}'", name)
                                             : fmt::format("give '{}' the unit {}", name, fmt::join(units, " or ")));
    }
  }
}

}  // namespace mechane::scenario
