#include "client-sdk/authoring/rename.hpp"

#include <optional>

#include <fmt/format.h>

#include "client-sdk/authoring/key_scope.hpp"
#include "server/machines/formula_names.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/values.hpp"

namespace mechane::authoring {
namespace {

using Holds = Scope::Holds;
using Map = std::map<std::string, std::string>;

/// Whether each element is in a prototype's body, which has its own DEFs.
std::vector<bool> in_prototypes(const x3d::Document& document) {
  std::vector<bool> inside(document.size(), false);
  for (std::size_t i = 0; i < document.size(); ++i) {
    const x3d::Node& node = document[x3d::NodeId(i)];
    // Parents come before their children.
    inside[i] = node.name == "ProtoBody" || (node.parent && inside[node.parent.index()]);
  }
  return inside;
}

bool is_own_set(const x3d::Document& document, x3d::NodeId id) {
  return document[id].name == "MetadataSet" && !document[id].used && x3d::name_of(document, id).starts_with("mechane:");
}

std::string attribute_of(const x3d::Node& node, std::string_view name) {
  const std::string* value = node.attribute(name);
  return value != nullptr ? *value : std::string();
}

/// The imported node's name in this file.
std::string import_name(const x3d::Node& import) {
  const std::string as = attribute_of(import, "AS");
  return as.empty() ? attribute_of(import, "importedDEF") : as;
}

/// Collects the free names of a tree.
void collect(const x3d::Document& document, x3d::NodeId set, const Scope& scope, NamesOf& out) {
  for (const x3d::NodeId child : document.child_elements(set)) {
    if (!document[child].name.starts_with("Metadata") || document[child].used) continue;
    const std::string name = x3d::name_of(document, child);
    if (scope.holds == Holds::components) out.things.insert(name);
    if (scope.holds == Holds::named) {
      if (scope.naming == scenario::Names::quantity) out.quantities.insert(name);
      if (scope.naming == scenario::Names::activity) out.activities.insert(name);
      if (scope.naming == scenario::Names::step) out.steps.insert(name);
      if (scope.table == &scenario::visit_table()) out.visits.insert(name);
      if (scope.table == &scenario::effect_table()) out.effects.insert(name);
    }
    if (document[child].name == "MetadataSet")
      collect(document, child, scope_of_child(document, scope, name, child), out);
  }
}

std::string changed(const Map& map, const std::string& name) {
  const auto it = map.find(name);
  return it == map.end() ? name : it->second;
}

/// Whether a RigidBody stands for many: COIN-1, COIN-2 ...
bool has_copies(const x3d::Document& document, x3d::NodeId body) {
  const x3d::NodeId set = x3d::find_set(document, body, "mechane:body");
  return set && x3d::find_child(document, set, "copies");
}

class Renamer {
 public:
  Renamer(const x3d::Document& document, const Renames& renames, TextEdits& edits)
      : document_(document), renames_(renames), edits_(edits) {
    for (const x3d::NodeId body : document.elements("RigidBody")) {
      const std::string def = attribute_of(document[body], "DEF");
      if (renames.things.contains(def) && has_copies(document, body)) copied_.insert(def);
    }
  }

  void run() {
    const std::vector<bool> inside = in_prototypes(document_);
    for (std::size_t i = 0; i < document_.size(); ++i) {
      const x3d::NodeId id(i);
      const x3d::Node& node = document_[id];
      if (node.kind != x3d::NodeKind::element) continue;
      if (node.name == "ProtoDeclare" || node.name == "ExternProtoDeclare" || node.name == "ProtoInstance")
        rename(id, "name", renames_.prototypes);
      if (inside[i]) continue;
      if (node.name == "RigidBody") keep_mesh_node(id);
      rename(id, "DEF", renames_.things);
      rename(id, "USE", renames_.things);
      rename_statement(id, node);
      if (is_own_set(document_, id)) rename_set(id, scope_of_set(document_, id));
    }
  }

 private:
  /// A body without the key `node` takes the node of its own name in the mesh file, which is not renamed: adds the key with that name.
  void keep_mesh_node(x3d::NodeId body) {
    const std::string* def = document_[body].attribute("DEF");
    if (def == nullptr || !renames_.things.contains(*def)) return;
    const x3d::NodeId set = x3d::find_set(document_, body, "mechane:body");
    if (!set || !x3d::find_child(document_, set, "model") || x3d::find_child(document_, set, "node")) return;
    append_inside(document_, set,
                  fmt::format("{}<MetadataString containerField='value' name='node' value='{}'/>",
                              inner_margin_of(document_, set), escape_attribute(quote_strings({*def}))),
                  edits_);
  }

  void rename(x3d::NodeId id, std::string_view attribute, const Map& map) {
    const std::string* value = document_[id].attribute(attribute);
    if (value != nullptr && map.contains(*value)) set_attribute(document_, id, attribute, map.at(*value), edits_);
  }

  void rename_statement(x3d::NodeId id, const x3d::Node& node) {
    if (node.name == "ROUTE") {
      rename(id, "fromNode", renames_.things);
      rename(id, "toNode", renames_.things);
    } else if (node.name == "EXPORT") {
      const std::string local = attribute_of(node, "localDEF");
      const std::string as = attribute_of(node, "AS");
      rename(id, "localDEF", renames_.things);
      // The name that other files import stays the same, unless another export has it.
      const std::string outside = changed(renames_.exports, as.empty() ? local : as);
      if (outside != changed(renames_.things, local) || !as.empty())
        set_attribute(document_, id, "AS", outside, edits_);
    } else if (node.name == "IMPORT") {
      rename(id, "inlineDEF", renames_.things);
      const std::string name = import_name(node);
      if (renames_.things.contains(name)) set_attribute(document_, id, "AS", renames_.things.at(name), edits_);
    }
  }

  /// The new name of a name, or of a copy: COIN-3 and COIN-* follow COIN. None where it keeps its name.
  [[nodiscard]] std::optional<std::string> new_name(const Map& map, const std::string& name) const {
    if (const auto it = map.find(name); it != map.end()) return it->second;
    const std::size_t dash = name.rfind('-');
    if (&map != &renames_.things || dash == std::string::npos || !copied_.contains(name.substr(0, dash)))
      return std::nullopt;
    const std::string number = name.substr(dash + 1);
    const bool is_copy =
        number == "*" || (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos);
    return is_copy ? std::optional(map.at(name.substr(0, dash)) + name.substr(dash)) : std::nullopt;
  }

  const Map* map_for(scenario::Names names) const {
    switch (names) {
      case scenario::Names::body:
      case scenario::Names::joint:
      case scenario::Names::agent:
      case scenario::Names::model:
      case scenario::Names::view:
        return &renames_.things;
      case scenario::Names::quantity:
        return &renames_.quantities;
      case scenario::Names::step:
        return &renames_.steps;
      case scenario::Names::activity:
        return &renames_.activities;
      case scenario::Names::source:
      case scenario::Names::formula:
      case scenario::Names::language:
      case scenario::Names::nothing:
        break;
    }
    return nullptr;
  }

  void rename_set(x3d::NodeId set, const Scope& scope) {
    // One of our sets may be within another one.
    if (!done_.insert(set.index()).second) return;
    for (const x3d::NodeId child : document_.child_elements(set)) {
      if (!document_[child].name.starts_with("Metadata") || document_[child].used) continue;
      const std::string name = x3d::name_of(document_, child);
      rename_name(child, scope, name);
      if (document_[child].name == "MetadataSet") {
        rename_set(child, scope_of_child(document_, scope, name, child));
      } else {
        rename_value(child, leaf_of(scope, name).names);
      }
    }
  }

  void rename_name(x3d::NodeId id, const Scope& scope, const std::string& name) {
    if (scope.holds == Holds::components) rename(id, "name", renames_.things);
    if (scope.holds == Holds::named) {
      if (scope.table == &scenario::visit_table()) rename(id, "name", renames_.visits);
      if (scope.table == &scenario::effect_table()) rename(id, "name", renames_.effects);
      if (const Map* map = map_for(scope.naming)) rename(id, "name", *map);
    }
    // "object:INNER"
    const scenario::Key* key = scope.holds == Holds::keys ? scope.table->find(name) : nullptr;
    if (key == nullptr || !key->name.ends_with(":*")) return;
    const Map* map = map_for(key->names);
    const std::size_t prefix = key->name.size() - 1;
    const auto renamed = map != nullptr ? new_name(*map, name.substr(prefix)) : std::nullopt;
    if (renamed) set_attribute(document_, id, "name", name.substr(0, prefix) + *renamed, edits_);
  }

  void rename_value(x3d::NodeId id, scenario::Names names) {
    const Map* map = map_for(names);
    if (map == nullptr && names != scenario::Names::source && names != scenario::Names::formula) return;
    const std::string* text = document_[id].attribute("value");
    if (text == nullptr || document_[id].name != "MetadataString") return;
    auto values = x3d::parse_strings(*text);
    if (!values) return;
    bool any = false;
    for (std::string& value : *values) {
      if (names == scenario::Names::formula) {
        any = rename_formula(value) || any;
        continue;
      }
      // A source, "PUMP.basin_l", is a name and one of its values.
      const std::size_t end = names == scenario::Names::source ? std::min(value.find('.'), value.size()) : value.size();
      const Map& of = names == scenario::Names::source ? renames_.things : *map;
      const auto renamed = new_name(of, value.substr(0, end));
      if (!renamed) continue;
      value = *renamed + value.substr(end);
      any = true;
    }
    if (any) set_attribute(document_, id, "value", quote_strings(*values), edits_);
  }

  /// Whether anything in it has a new name.
  bool rename_formula(std::string& formula) const {
    bool any = false;
    auto found = machines::names_in_formula(formula);
    for (auto name = found.rbegin(); name != found.rend(); ++name) {
      const Map& map = name->quantity ? renames_.quantities : renames_.things;
      const auto it = map.find(formula.substr(name->begin, name->length));
      if (it == map.end()) continue;
      formula.replace(name->begin, name->length, it->second);
      any = true;
    }
    return any;
  }

  const x3d::Document& document_;
  const Renames& renames_;
  TextEdits& edits_;
  std::set<std::size_t> done_;
  std::set<std::string> copied_;  ///< RigidBodies that stand for many, and get a new name
};

Map new_names(const std::set<std::string>& ours, const std::set<std::string>& theirs) {
  Map map;
  std::set<std::string> taken = ours;
  taken.insert(theirs.begin(), theirs.end());
  for (const std::string& name : theirs) {
    if (name.empty() || !ours.contains(name)) continue;
    int number = 2;
    while (taken.contains(fmt::format("{}_{}", name, number)))
      ++number;
    map[name] = *taken.insert(fmt::format("{}_{}", name, number)).first;
  }
  return map;
}

}  // namespace

NamesOf names_of_file(const x3d::Document& document) {
  NamesOf out;
  const std::vector<bool> inside = in_prototypes(document);
  for (std::size_t i = 0; i < document.size(); ++i) {
    const x3d::NodeId id(i);
    const x3d::Node& node = document[id];
    if (node.kind != x3d::NodeKind::element || inside[i]) continue;
    if (const std::string def = attribute_of(node, "DEF"); !def.empty()) out.things.insert(def);
    if (node.name == "IMPORT") out.things.insert(import_name(node));
    if (node.name == "ProtoDeclare" || node.name == "ExternProtoDeclare")
      out.prototypes.insert(attribute_of(node, "name"));
    if (node.name == "EXPORT") {
      const std::string as = attribute_of(node, "AS");
      out.exports.insert(as.empty() ? attribute_of(node, "localDEF") : as);
    }
    if (is_own_set(document, id)) collect(document, id, scope_of_set(document, id), out);
  }
  return out;
}

Renames renames_for(const NamesOf& ours, const NamesOf& theirs) {
  Renames out;
  out.things = new_names(ours.things, theirs.things);
  out.prototypes = new_names(ours.prototypes, theirs.prototypes);
  out.exports = new_names(ours.exports, theirs.exports);
  out.quantities = new_names(ours.quantities, theirs.quantities);
  out.activities = new_names(ours.activities, theirs.activities);
  out.steps = new_names(ours.steps, theirs.steps);
  out.visits = new_names(ours.visits, theirs.visits);
  out.effects = new_names(ours.effects, theirs.effects);
  return out;
}

void rename_in(const x3d::Document& document, const Renames& renames, TextEdits& edits) {
  Renamer(document, renames, edits).run();
}

}  // namespace mechane::authoring
