// X3D 4.0's own tables: its node types, their fields with type, range and default, and which node may fill which field of another.
// What Mechane does with a node is in server/scenario/schema.hpp.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/x3d/values.hpp"

namespace mechane::x3d {

/// A field that holds values, an attribute in XML.
struct Field {
  std::string_view name;
  std::string_view type;           ///< as the standard calls it: "SFVec3f"
  std::string_view default_value;  ///< numbers separated by commas; empty: no default, or an empty list
  double min = 0;                  ///< of every number; see the flags
  double max = 0;
  bool has_min = false;
  bool has_max = false;
  bool above_min = false;  ///< the end itself is not allowed
  bool below_max = false;

  /// "0 to 1", "above 0", "0 or more"; empty where any number is allowed.
  [[nodiscard]] std::string range() const;
  /// What is wrong with a value as written in the file, and what to write instead; none where it is right.
  [[nodiscard]] std::optional<BadValue> fault(std::string_view text) const;
};

/// A field that holds nodes.
struct Slot {
  std::string_view name;
  bool many = false;
  std::vector<std::string_view> accepts;  ///< types, abstract ones too
};

struct NodeType {
  std::string_view name;
  std::string_view
      container;  ///< the parent's field that it fills where containerField is not written; empty: a statement
  std::vector<std::string_view> bases;
  std::vector<Field> fields;  ///< its own and those of its bases, by name
  std::vector<Slot> slots;

  [[nodiscard]] const Field* field(std::string_view name) const;
  [[nodiscard]] const Slot* slot(std::string_view name) const;
  [[nodiscard]] bool is_abstract() const { return name.starts_with("X3D") && name != "X3D"; }
  /// Whether it is a statement like ROUTE, head or ProtoDeclare, and not a node.
  [[nodiscard]] bool is_statement() const;
};

/// All types. Immutable; any thread.
class Schema {
 public:
  /// The schema of X3D 4.0, made at the first call.
  [[nodiscard]] static const Schema& standard();

  /// The type of that name; null where X3D has no such element.
  [[nodiscard]] const NodeType* find(std::string_view name) const;
  /// Whether a type is `base` or inherits from it.
  [[nodiscard]] bool is_a(std::string_view type, std::string_view base) const;
  [[nodiscard]] bool accepts(const Slot& slot, std::string_view type) const;
  /// The names of all elements that a file may hold, in alphabetical order.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  Schema();
  std::map<std::string_view, NodeType> types_;
};

}  // namespace mechane::x3d
