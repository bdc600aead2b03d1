// Tables of every key that a scenario may hold: keys of its metadata, and the fields of X3D's nodes that Mechane reads. They give the
// reader types, ranges and defaults, the checker its remedies, the merge the references between names, the reference page its text.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/x3d/values.hpp"

namespace mechane::scenario {

enum class ValueKind {
  string,    ///< one string
  strings,   ///< any count of strings
  number,    ///< one number (Double, Float or Integer)
  numbers,   ///< any count of numbers
  vector,    ///< three numbers
  rotation,  ///< four: axis, angle in radians
  matrix,    ///< nine, of a 3x3 matrix; fields of nodes only
  boolean,
  set,  ///< a MetadataSet with a table of its own, or with free names
};

/// What a string names. A formula names joints and quantities among other words.
enum class Names { nothing, body, joint, agent, quantity, step, activity, model, source, language, view, formula };

struct Table;

/// The limit of a direction's numbers, and of an angle in radians.
inline constexpr double kLargest = 1e6;

struct Key {
  std::string_view name;  ///< "trigger:*" is every name with that beginning, "*" any name
  ValueKind kind = ValueKind::string;
  std::string_view unit = {};
  std::string_view summary = {};
  std::string_view example = {};
  bool required = false;
  std::string_view unless = {};        ///< a required key may be left out where a key of this name is given
  std::string_view default_text = {};  ///< of a string
  double default_number = 0;           ///< of a number, of every number of a vector; a boolean: not 0 is true
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::string_view choices = {};  ///< of a string: the words allowed, separated by blanks; empty: any
  Names names = Names::nothing;   ///< what the strings name; of a set "object:*": what the star names
  const Table* inner = nullptr;   ///< of a set: its own table; with free names, the table of each set in it
  bool free_names = false;        ///< of a set: the author chooses the names in it
};

struct Table {
  std::string_view name;  ///< what the set is: "step"; of a node's table: the node's type
  std::string_view summary;
  std::span<const Key> keys;

  /// The key of that name; null where the table has none.
  [[nodiscard]] const Key* find(std::string_view name) const;
  /// The key of that name. That it is missing, or of another kind, is our own bug.
  const Key& key(std::string_view name, ValueKind kind) const;
};

inline constexpr int kFormatVersion = 1;

[[nodiscard]] const Table& scenario_table();  ///< `mechane:scenario` on the WorldInfo
[[nodiscard]] const Table& quantity_table();  ///< a quantity written as a set
[[nodiscard]] const Table& activity_table();
[[nodiscard]] const Table& question_table();  ///< one of an activity's questionnaire
[[nodiscard]] const Table& step_table();
[[nodiscard]] const Table& effect_table();    ///< one of the scenario's effects
[[nodiscard]] const Table& override_table();  ///< `object:NAME` in a step
[[nodiscard]] const Table& trigger_table();   ///< `trigger:N` in a step
[[nodiscard]] const Table& rule_table();      ///< `rule:N` in a trigger
[[nodiscard]] const Table& text_table();      ///< `text`: keys are "<what>.<language>"
[[nodiscard]] const Table& visit_table();
[[nodiscard]] const Table& move_table();    ///< `move:N` in a visit
[[nodiscard]] const Table& haptic_table();  ///< `mechane:haptic` on a RigidBody
[[nodiscard]] const Table& body_table();    ///< `mechane:body` on a RigidBody
[[nodiscard]] const Table& copies_table();  ///< `copies` in a `mechane:body`
[[nodiscard]] std::span<const Table* const> all_tables();

/// The nodes of X3D that Mechane reads, each with the fields that it reads: types and defaults are X3D's own (x3d/schema.hpp).
[[nodiscard]] std::span<const Table> node_tables();
/// The table of a node type; null where Mechane does not read such nodes.
[[nodiscard]] const Table* find_node_table(std::string_view node_type);

/// Splits words that are separated by single blanks, like a Key's choices.
[[nodiscard]] std::vector<std::string> words_of(std::string_view list);
/// Whether a word is one of a Key's choices.
[[nodiscard]] bool one_of(std::string_view word, std::string_view choices);
/// Whether a name matches a key's pattern: "trigger:1" matches "trigger:*".
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name);
/// What is wrong with a key's numbers or string by its range and choices; none where they are right.
[[nodiscard]] std::optional<x3d::BadValue> range_fault(const Key& key, std::span<const double> numbers,
                                                       const std::string* text);

/// A key's unit, range and choices in words: "s, 0 to 3600". For remedies and tables; may be empty.
[[nodiscard]] std::string limits_of(const Key& key);
/// What to write for a kind of value, by its metadata node: "MetadataDouble with 3 numbers".
[[nodiscard]] std::string_view kind_in_words(ValueKind kind);

}  // namespace mechane::scenario
