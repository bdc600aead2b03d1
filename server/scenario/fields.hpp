// A set of metadata, read by the schema's table of its keys: typed values, and problems for faulty ones.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/math.hpp"
#include "server/scenario/schema.hpp"
#include "server/x3d/metadata.hpp"

namespace mechane::scenario {

/// A set checked against its table of the schema: a key that is nearly a known one is an error, any other unknown key a warning; wrong
/// types, counts, ranges and missing keys are errors. Values that are not written, or are wrong, read as the table's default.
class Fields {
 public:
  /// `where` names the set for people: "step turn". `set` must outlive this; null reads as empty.
  Fields(const x3d::Metadata* set, const Table& table, std::string where, x3d::Problems& problems);

  [[nodiscard]] bool given(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  /// Whether some key is missing, misspelt or wrong, which has been reported. What seems to be wrong between keys may follow from it.
  [[nodiscard]] bool has_faults() const { return has_faults_; }
  /// Those of a number, of numbers or of a vector, as they are written; none where it is not given.
  [[nodiscard]] std::vector<double> numbers(std::string_view key) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string string(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> strings(std::string_view key) const;
  [[nodiscard]] Vec3 vector(std::string_view key) const;
  /// An X3D rotation: axis x y z, angle in radians.
  [[nodiscard]] Quat rotation(std::string_view key) const;
  /// The set of that key; null where it is not given.
  [[nodiscard]] const x3d::Metadata* set(std::string_view key) const;
  /// Sets whose names begin with the key's prefix ("trigger:" of the key "trigger:*"), in the order written.
  [[nodiscard]] std::vector<const x3d::Metadata*> sets_like(std::string_view key) const;
  /// The line of a key, or of the set where it is not given.
  [[nodiscard]] int line(std::string_view key) const;
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const x3d::Metadata* value(std::string_view name) const;
  void check(x3d::Problems& problems);
  bool has_like(std::string_view pattern) const;
  bool check_value(const Key& key, const x3d::Metadata& value, x3d::Problems& problems) const;

  const x3d::Metadata* set_ = nullptr;
  const Table& table_;
  std::string where_;
  std::map<std::string, const x3d::Metadata*, std::less<>> good_;
  bool has_faults_ = false;
};

}  // namespace mechane::scenario
