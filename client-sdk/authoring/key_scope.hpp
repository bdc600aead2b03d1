// What a set of metadata may hold, by the schema: for whoever walks the tree of a file (an editor, a merge).
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
    nothing,     ///< not ours
    keys,        ///< the keys of `table`
    named,       ///< sets named as the author likes, each with the keys of `table`
    components,  ///< the same, each an agent or a machine
    parameters,  ///< those of one agent or machine, beside its type
  };
  Holds holds = Holds::nothing;
  const scenario::Table* table = nullptr;
  scenario::Names naming = scenario::Names::nothing;  ///< what the free names of `named` and `components` are names of
  std::span<const state::ComponentType> types;
  const state::ComponentType* type = nullptr;  ///< of `parameters`; null where it is not known
};

/// What a value may be.
struct Leaf {
  bool known = false;
  scenario::ValueKind kind = scenario::ValueKind::string;
  scenario::Names names = scenario::Names::nothing;
};

/// Of a set that stands on a node: "mechane:scenario", "mechane:agent" and so on; `id` is the set's element.
[[nodiscard]] Scope scope_of_set(const x3d::Document& document, x3d::NodeId id);
/// Of a set in a set. `child` may be none: then the name alone decides, and an agent's type is not known.
[[nodiscard]] Scope scope_of_child(const x3d::Document& document, const Scope& scope, std::string_view name,
                                   x3d::NodeId child);
/// Of a value in a set.
[[nodiscard]] Leaf leaf_of(const Scope& scope, std::string_view name);
/// Names that a set may hold, for suggestions; empty where they are free.
[[nodiscard]] std::vector<std::string> names_in(const Scope& scope);

}  // namespace mechane::authoring
