// What a set of metadata may hold, by the schema: for whoever walks the tree of a file (an editor, a merge).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/scenario/document.hpp"
#include "server/scenario/schema.hpp"
#include "server/state/component_type.hpp"

namespace mechane::scenario {

struct Scope {
  enum class Holds {
    nothing,     ///< not ours
    keys,        ///< the keys of `table`
    named,       ///< sets named as the author likes, each with the keys of `table`
    components,  ///< the same, each an agent or a machine
    parameters,  ///< those of one agent or machine, beside its type
  };
  Holds holds = Holds::nothing;
  const Table* table = nullptr;
  Names naming = Names::nothing;  ///< what the free names of `named` and `components` are names of
  std::span<const state::ComponentType> types;
  const state::ComponentType* type = nullptr;  ///< of `parameters`; null where it is not known
};

/// What a value may be.
struct Leaf {
  bool known = false;
  ValueKind kind = ValueKind::string;
  Names names = Names::nothing;
};

/// Of a set that stands on a node: "mechane:scenario", "mechane:agent" and so on; `id` is the set's element.
[[nodiscard]] Scope scope_of_set(const Document& document, NodeId id);
/// Of a set in a set. `child` may be none: then the name alone decides, and an agent's type is not known.
[[nodiscard]] Scope scope_of_child(const Document& document, const Scope& scope, std::string_view name, NodeId child);
/// Of a value in a set.
[[nodiscard]] Leaf leaf_of(const Scope& scope, std::string_view name);
/// Names that a set may hold, for suggestions; empty where they are free.
[[nodiscard]] std::vector<std::string> names_in(const Scope& scope);

/// The metadata element of that name which fills the field `value` of a set; none where there is none. USE is resolved.
[[nodiscard]] NodeId find_child(const Document& document, NodeId set, std::string_view name);
/// The set of that name on an element, or in the set that stands on it, as read_metadata() finds it.
[[nodiscard]] NodeId find_set(const Document& document, NodeId owner, std::string_view name);
/// The name of a metadata element, with USE resolved.
[[nodiscard]] std::string name_of(const Document& document, NodeId metadata);

}  // namespace mechane::scenario
