// X3D's metadata nodes as typed values with lines, and access to them through the schema of keys.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/math.hpp"
#include "server/scenario/document.hpp"
#include "server/scenario/schema.hpp"

namespace mechane::scenario {

enum class MetadataKind { set, strings, numbers, integers, booleans };

/// One Metadata node with what it holds; USE is resolved.
struct Metadata {
  std::string name;
  MetadataKind kind = MetadataKind::set;
  int line = 0;
  std::vector<std::string> strings;
  std::vector<double> numbers;  ///< MetadataDouble, -Float, -Integer: finite
  std::vector<bool> booleans;
  std::vector<Metadata> children;  ///< of a set: what fills its field `value`

  [[nodiscard]] const Metadata* find(std::string_view child) const;
};

/// The MetadataSet of that name on an element, read whole: the element's own metadata node, or a set in it, because X3D allows one
/// metadata node an element. None where there is none, or where its values are faulty (then there is a problem).
[[nodiscard]] std::optional<Metadata> read_metadata(const Document& document, NodeId owner, std::string_view name,
                                                    Problems& problems);

/// A set held against its table of the schema: a key that is nearly a known one is an error, any other unknown key a warning; wrong
/// types, counts, ranges and missing keys are errors. Values that were not written, or are wrong, read as the table's default.
class Fields {
 public:
  /// `where` names the set for people: "step turn". `set` must outlive this; null reads as empty.
  Fields(const Metadata* set, const Table& table, std::string where, Problems& problems);

  [[nodiscard]] bool given(std::string_view key) const;
  [[nodiscard]] double number(std::string_view key) const;
  [[nodiscard]] bool boolean(std::string_view key) const;
  [[nodiscard]] std::string string(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> strings(std::string_view key) const;
  [[nodiscard]] Vec3 vector(std::string_view key) const;
  /// An X3D rotation: axis x y z, angle in radians.
  [[nodiscard]] Quat rotation(std::string_view key) const;
  /// Null where it is not given.
  [[nodiscard]] const Metadata* set(std::string_view key) const;
  /// Sets whose names begin with the key's prefix ("trigger:" of the key "trigger:*"), in the order written.
  [[nodiscard]] std::vector<const Metadata*> sets_like(std::string_view key) const;
  /// The line of a key, or of the set where it is not given.
  [[nodiscard]] int line(std::string_view key) const;
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const Key& key(std::string_view name, ValueKind kind) const;
  const Metadata* value(std::string_view name) const;
  void check(Problems& problems);
  bool has_like(std::string_view pattern) const;
  bool check_value(const Key& key, const Metadata& value, Problems& problems) const;

  const Metadata* set_ = nullptr;
  const Table& table_;
  std::string where_;
  std::map<std::string, const Metadata*, std::less<>> good_;
};

}  // namespace mechane::scenario
