// X3D's metadata nodes as typed values with lines.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/x3d/document.hpp"
#include "server/x3d/values.hpp"

namespace mechane::x3d {

enum class MetadataKind { set, strings, numbers, integers, booleans, unreadable };

/// One Metadata node with its content; USE is resolved. One whose value cannot be read has no content: its fault has been reported.
struct Metadata {
  std::string name;
  MetadataKind kind = MetadataKind::set;
  int line = 0;
  std::vector<std::string> strings;
  std::vector<double> numbers;  ///< MetadataDouble, -Float, -Integer: finite
  DecimalCommas commas;         ///< in the text of the numbers
  std::vector<bool> booleans;
  std::vector<Metadata> children;  ///< of a set: what fills its field `value`

  [[nodiscard]] const Metadata* find(std::string_view child) const;
};

/// The MetadataSet of that name on an element, with all that is in it. It is the element's own metadata node, or a set within that node,
/// because X3D allows one metadata node per element. None where the element has no such set, or where it is too large (which is added to
/// `problems`, as is each value that cannot be read).
[[nodiscard]] std::optional<Metadata> read_metadata(const Document& document, NodeId owner, std::string_view name,
                                                    Problems& problems);

/// The metadata element of that name in the field `value` of a set; none where the set has none. USE is resolved.
[[nodiscard]] NodeId find_child(const Document& document, NodeId set, std::string_view name);
/// The set of that name on an element, or within the element's own set, as read_metadata() finds it.
[[nodiscard]] NodeId find_set(const Document& document, NodeId owner, std::string_view name);
/// The name of a metadata element, with USE resolved.
[[nodiscard]] std::string name_of(const Document& document, NodeId metadata);

}  // namespace mechane::x3d
