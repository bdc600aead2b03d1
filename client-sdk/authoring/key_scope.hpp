// What a set of metadata may hold, by the schema: for the editor and the merge, which walk the tree of a file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/scenario/schema.hpp"
#include "server/state/component_type.hpp"
#include "server/x3d/document.hpp"

namespace mechane::authoring {

struct Scope {
  enum class Holds {
    nothing,     ///< it is not one of our sets
    keys,        ///< the keys of `table`
    named,       ///< sets with names of the author's choice, each with the keys of `table`
    components,  ///< the same, each an agent or a machine
    parameters,  ///< the type and the parameters of one agent or machine
  };
  Holds holds = Holds::nothing;
  const scenario::Table* table = nullptr;
  scenario::Names naming = scenario::Names::nothing;  ///< what the author's names in `named` and `components` name
  std::span<const state::ComponentType> types;
  const state::ComponentType* type = nullptr;  ///< of `parameters`; null where it is not known
};

/// The kind of a value, and what it names.
struct Leaf {
  bool known = false;
  scenario::ValueKind kind = scenario::ValueKind::string;
  scenario::Names names = scenario::Names::nothing;
};

/// The scope of a set on a node: "mechane:scenario", "mechane:agent" and so on; `id` is the set's element.
[[nodiscard]] Scope scope_of_set(const x3d::Document& document, x3d::NodeId id);
/// The scope of a set within a set. `child` may be none: then only the name decides, and an agent's type is not known.
[[nodiscard]] Scope scope_of_child(const x3d::Document& document, const Scope& scope, std::string_view name,
                                   x3d::NodeId child);
/// The kind of a value in a set.
[[nodiscard]] Leaf leaf_of(const Scope& scope, std::string_view name);
/// Names that a set may hold, for suggestions; empty where the author chooses them.
[[nodiscard]] std::vector<std::string> names_in(const Scope& scope);

}  // namespace mechane::authoring
