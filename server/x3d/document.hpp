// An X3D file as a tree: its elements and texts in the order written, with their places, so that an error can say where, and an editor
// can change one place and leave the rest. DEF and USE are resolved; nothing is copied or expanded. Knows XML and X3D's naming, not
// machines.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/ids.hpp"
#include "server/x3d/problem.hpp"
#include "server/x3d/start_tag.hpp"

namespace mechane::x3d {

using NodeId = Id<struct NodeTag>;

/// Caps on the size of a file. A file over a cap is an error, so that it cannot slow down or stop a server.
struct DocumentLimits {
  std::size_t bytes = 16u << 20;
  std::size_t depth = 200;
  std::size_t nodes = 200'000;
  std::size_t metadata_bytes = 4u << 20;  ///< of all values of Metadata nodes together
};

/// Comments, the DOCTYPE and instructions are kept in Document::source() only.
enum class NodeKind : std::uint8_t { element, text };

/// Offsets into the text: <name ...>inner</name>, or <name .../>, where tag_end, inner_end and end are the same.
struct ElementSpan {
  std::uint32_t begin = 0;
  std::uint32_t tag_end = 0;    ///< after the start tag
  std::uint32_t inner_end = 0;  ///< of the end tag's <
  std::uint32_t end = 0;
};

struct Attribute {
  std::string name;
  std::string value;   ///< with its references resolved
  AttributeSpan span;  ///< where it stands in Document::source()
};

struct Node {
  NodeKind kind = NodeKind::element;
  std::string name;                   ///< of an element: its type, "RigidBody"
  std::string text;                   ///< of a text, with its references resolved
  std::vector<Attribute> attributes;  ///< in the order written
  NodeId parent;                      ///< none for the outermost element
  std::vector<NodeId> children;
  NodeId used;  ///< of an element with USE: the element it refers to
  int line = 0;
  ElementSpan span;  ///< of an element: where it stands in Document::source()

  /// The attribute's value; null where it is not written.
  [[nodiscard]] const std::string* attribute(std::string_view name) const;
};

/// One file. Immutable once read; any thread may look. To change a file, see editor.hpp.
class Document {
 public:
  [[nodiscard]] const Node& operator[](NodeId id) const { return nodes_[id.index()]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] NodeId x3d() const { return x3d_; }
  [[nodiscard]] NodeId scene() const { return scene_; }
  /// The element of that DEF, outside prototypes; none where no element has it.
  [[nodiscard]] NodeId find_def(std::string_view def) const;
  /// The element itself, or the one that its USE refers to.
  [[nodiscard]] NodeId resolve(NodeId id) const;
  /// All elements of a type under the Scene, in the order written; without USEs, and without the insides of prototypes.
  [[nodiscard]] std::vector<NodeId> elements(std::string_view type) const;
  /// Children that are elements, as written (not resolved).
  [[nodiscard]] std::vector<NodeId> child_elements(NodeId id) const;
  /// Which field of its parent an element fills: its containerField, or `otherwise`.
  [[nodiscard]] std::string container_field(NodeId id, std::string_view otherwise) const;
  /// "RigidBody INNER", or "RigidBody" where it has no DEF.
  [[nodiscard]] std::string describe(NodeId id) const;
  /// DEFs outside prototypes of elements of a type (of all types: empty), for suggestions.
  [[nodiscard]] std::vector<std::string> defs(std::string_view type) const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// All bytes that were read.
  [[nodiscard]] const std::string& source() const { return source_; }

 private:
  friend class DocumentBuilder;
  std::filesystem::path path_;
  std::string source_;
  std::vector<Node> nodes_;
  std::map<std::string, NodeId, std::less<>> defs_;
  NodeId x3d_;
  NodeId scene_;
};

/// Reads a file. Problems are added to `problems`; the Error is the first of them: unreadable (not_found, io_failure), over a cap
/// (too_large), not UTF-8 or not well-formed XML (damaged), entities declared (not_supported), not X3D (invalid_value) or not of version
/// 3 or 4 (wrong_version), no Scene (missing), a DEF given twice (duplicate), a USE without DEF (unknown_name), of another type or in a
/// circle (conflict). Any thread; takes no lock; reads only this file.
[[nodiscard]] Expected<Document> read_document(const std::filesystem::path& path, Problems& problems,
                                               const DocumentLimits& limits = {});

/// The same from memory. `path` is the name in messages, and urls are relative to its folder; it is not opened.
[[nodiscard]] Expected<Document> read_document(std::string_view bytes, const std::filesystem::path& path,
                                               Problems& problems, const DocumentLimits& limits = {});

}  // namespace mechane::x3d
