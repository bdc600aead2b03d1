// Every key that a scenario's metadata may hold, in tables: what the reader checks against, and what a form or a manual is made from.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace mechane::scenario {

enum class ValueKind {
  string,    ///< one string
  strings,   ///< any count of strings
  number,    ///< one number (Double, Float or Integer)
  vector,    ///< three numbers
  rotation,  ///< four: axis, angle in radians
  boolean,
  set,  ///< a MetadataSet with a table of its own, or with free names
};

struct Key {
  std::string_view name;  ///< "trigger:*" stands for every name with that beginning, "*" for any name
  ValueKind kind = ValueKind::string;
  std::string_view unit = {};
  std::string_view summary = {};
  std::string_view example = {};
  bool required = false;
  std::string_view default_text = {};  ///< of a string
  double default_number = 0;           ///< of a number, of every number of a vector; a boolean: not 0 is true
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::string_view choices = {};  ///< of a string: the words allowed, separated by blanks; empty: any
};

struct Table {
  std::string_view name;  ///< what the set is: "step"
  std::string_view summary;
  std::span<const Key> keys;
};

inline constexpr int kFormatVersion = 1;

[[nodiscard]] const Table& scenario_table();  ///< `mechane:scenario` on the WorldInfo
[[nodiscard]] const Table& quantity_table();  ///< a quantity written as a set
[[nodiscard]] const Table& activity_table();
[[nodiscard]] const Table& step_table();
[[nodiscard]] const Table& override_table();  ///< `object:NAME` in a step
[[nodiscard]] const Table& trigger_table();   ///< `trigger:N` in a step
[[nodiscard]] const Table& text_table();      ///< `text`: keys are "<what>.<language>"
[[nodiscard]] const Table& visit_table();
[[nodiscard]] const Table& move_table();    ///< `move:N` in a visit
[[nodiscard]] const Table& haptic_table();  ///< `mechane:haptic` on a RigidBody
[[nodiscard]] const Table& body_table();    ///< `mechane:body` on a RigidBody
[[nodiscard]] std::span<const Table* const> all_tables();

/// The tables for people, one line a key: what `mechane check --keys` prints.
[[nodiscard]] std::string describe_tables();

}  // namespace mechane::scenario
