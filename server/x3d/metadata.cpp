#include "server/x3d/metadata.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace mechane::x3d {
namespace {

// Each USE is read as a copy, and copies of copies multiply, so the size of one set is limited.
constexpr std::size_t kMostNodes = 100'000;
constexpr std::size_t kMostBytes = 8u << 20;
constexpr std::size_t kDeepest = 64;

std::string attribute_or(const Node& node, std::string_view name, const std::string& otherwise) {
  const std::string* value = node.attribute(name);
  return value != nullptr ? *value : otherwise;
}

/// Reads one tree of metadata.
class MetadataReader {
 public:
  MetadataReader(const Document& document, Problems& problems) : document_(document), problems_(problems) {}

  /// False where the tree is too large.
  bool read(NodeId id, std::size_t depth, Metadata& out) {
    const Node& node = document_[document_.resolve(id)];
    out.line = document_[id].line;
    out.name = attribute_or(node, "name", {});
    const std::string* value = node.attribute("value");
    bytes_ += value != nullptr ? value->size() : 0;
    if (++nodes_ > kMostNodes || bytes_ > kMostBytes || depth > kDeepest) {
      report(ErrorCode::too_large, out, "the metadata is too large or too deep, counting every USE as a copy",
             "shorten it, or use USE less often");
      return false;
    }
    if (node.name == "MetadataSet") return read_children(document_.resolve(id), depth, out);
    read_value(node.name, value != nullptr ? *value : std::string(), out);
    return true;
  }

 private:
  void report(ErrorCode code, const Metadata& at, std::string what, std::string remedy) {
    problems_.error(code, at.line, fmt::format("metadata '{}'", at.name), std::move(what), std::move(remedy));
  }

  bool read_children(NodeId set, std::size_t depth, Metadata& out) {
    for (const NodeId child : document_.child_elements(set)) {
      if (!document_[child].name.starts_with("Metadata") || document_.container_field(child, "value") != "value")
        continue;
      Metadata metadata;
      if (!read(child, depth + 1, metadata)) return false;
      if (const Metadata* before = out.find(metadata.name)) {
        report(ErrorCode::duplicate, metadata,
               fmt::format("'{}' is already given in line {}", metadata.name, before->line), "keep one of them");
      } else {
        out.children.push_back(std::move(metadata));
      }
    }
    return true;
  }

  /// A value that cannot be read stays in its set, so that nobody takes it for one that is missing.
  void read_value(const std::string& type, const std::string& text, Metadata& out) {
    out.kind = MetadataKind::unreadable;
    if (type == "MetadataString") return take(parse_strings(text), MetadataKind::strings, out.strings, out);
    if (text.find('"') != std::string::npos)
      return report(ErrorCode::invalid_value, out, fmt::format("a {} cannot hold text", type),
                    "write a MetadataString, or remove the quotes");
    out.commas = decimal_commas(text);
    if (type == "MetadataDouble" || type == "MetadataFloat")
      return take(parse_numbers(text), MetadataKind::numbers, out.numbers, out);
    if (type == "MetadataInteger") return take(parse_integers(text), MetadataKind::integers, out.numbers, out);
    if (type == "MetadataBoolean") return take(parse_booleans(text), MetadataKind::booleans, out.booleans, out);
    report(ErrorCode::unknown_name, out, fmt::format("{} is not a metadata node of X3D", type),
           "use MetadataSet, String, Double, Float, Integer or Boolean");
  }

  template <class T>
  void take(Value<std::vector<T>> value, MetadataKind kind, std::vector<T>& into, Metadata& out) {
    if (!value) return report(ErrorCode::invalid_value, out, value.error().what, value.error().remedy);
    out.kind = kind;
    into = std::move(*value);
  }

  const Document& document_;
  Problems& problems_;
  std::size_t nodes_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace

std::string name_of(const Document& document, NodeId metadata) {
  const std::string* name = document[document.resolve(metadata)].attribute("name");
  return name != nullptr ? *name : std::string();
}

NodeId find_child(const Document& document, NodeId set, std::string_view name) {
  for (const NodeId child : document.child_elements(document.resolve(set))) {
    if (document[child].name.starts_with("Metadata") && document.container_field(child, "value") == "value" &&
        name_of(document, child) == name)
      return document.resolve(child);
  }
  return NodeId::none();
}

NodeId find_set(const Document& document, NodeId owner, std::string_view name) {
  const auto is_named = [&](NodeId id) { return document[id].name == "MetadataSet" && name_of(document, id) == name; };
  NodeId found;
  for (const NodeId child : document.child_elements(owner)) {
    if (!document[child].name.starts_with("Metadata") || document.container_field(child, "metadata") != "metadata")
      continue;
    if (is_named(child)) found = child;
    for (const NodeId inner : document.child_elements(document.resolve(child))) {
      if (!found && is_named(inner)) found = inner;
    }
  }
  return found ? document.resolve(found) : found;
}

const Metadata* Metadata::find(std::string_view child) const {
  const auto it = std::find_if(children.begin(), children.end(), [&](const Metadata& m) { return m.name == child; });
  return it == children.end() ? nullptr : &*it;
}

std::optional<Metadata> read_metadata(const Document& document, NodeId owner, std::string_view name,
                                      Problems& problems) {
  const NodeId found = find_set(document, owner, name);
  Metadata metadata;
  if (!found || !MetadataReader(document, problems).read(found, 0, metadata)) return std::nullopt;
  return metadata;
}

}  // namespace mechane::x3d
