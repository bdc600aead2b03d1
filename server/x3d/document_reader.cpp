// Bytes to a Document: the caps first, then what keeps it from being XML, then pugixml, then a copy of its tree in the order written, then DEF and USE.
#include <algorithm>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "server/base/utf8.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/uses.hpp"

namespace mechane::x3d {
namespace {

// An attribute takes five bytes in a file and a hundred in memory.
constexpr std::size_t kMostAttributes = 1'000'000;

/// Offsets to lines.
class Lines {
 public:
  explicit Lines(std::string_view bytes) {
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      if (bytes[i] == '\n') ends_.push_back(i);
    }
  }
  [[nodiscard]] int at(std::ptrdiff_t offset) const {
    if (offset < 0) return 0;
    const auto it = std::lower_bound(ends_.begin(), ends_.end(), static_cast<std::size_t>(offset));
    return static_cast<int>(it - ends_.begin()) + 1;
  }

 private:
  std::vector<std::size_t> ends_;
};

NodeKind kind_of(pugi::xml_node_type type) {
  switch (type) {
    case pugi::node_element:
      return NodeKind::element;
    case pugi::node_comment:
      return NodeKind::comment;
    case pugi::node_cdata:
      return NodeKind::cdata;
    case pugi::node_doctype:
      return NodeKind::doctype;
    case pugi::node_declaration:
      return NodeKind::declaration;
    case pugi::node_pi:
      return NodeKind::instruction;
    default:
      return NodeKind::text;
  }
}

bool is_metadata(const Node& node) {
  return node.kind == NodeKind::element && node.name.starts_with("Metadata");
}

std::string megabytes(std::size_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / (1u << 20));
}

}  // namespace

/// Fills one Document. Its methods are the stages, in order; each returns false after it has said what is wrong.
class DocumentBuilder {
 public:
  DocumentBuilder(std::string_view bytes, const std::filesystem::path& path, Problems& problems,
                  const DocumentLimits& limits)
      : bytes_(bytes),
        problems_(problems),
        limits_(limits),
        lines_(bytes.substr(0, std::min(bytes.size(), limits.bytes))) {
    document_.path_ = path;
  }

  Expected<Document> build() {
    if (!check_bytes() || !parse() || !copy_tree() || !find_scene()) return tl::unexpected(problems_.first_error());
    resolve_uses(document_.nodes_, document_.defs_, problems_);
    if (problems_.has_errors()) return tl::unexpected(problems_.first_error());
    document_.source_ = std::string(bytes_);
    return std::move(document_);
  }

 private:
  bool refuse(int line, std::string node, std::string what, std::string remedy) {
    problems_.error(line, std::move(node), std::move(what), std::move(remedy));
    return false;
  }

  /// What can be known before a parser sees the file, so that no parser has to be trusted with more memory than the caps allow.
  bool check_bytes() {
    if (bytes_.size() > limits_.bytes) {
      return refuse(
          0, {},
          fmt::format("the file has {}, more than the {} allowed", megabytes(bytes_.size()), megabytes(limits_.bytes)),
          "put meshes into .glb files and name them by Inline");
    }
    if (bytes_.find_first_not_of(" \t\r\n") == std::string_view::npos)
      return refuse(0, {}, "the file is empty", "write an X3D scene");
    if (const auto bad = first_bad_utf8(bytes_)) {
      return refuse(lines_.at(static_cast<std::ptrdiff_t>(*bad)), {}, "the text is not UTF-8",
                    "save the file as UTF-8");
    }
    // An element has one or two '<'; text inside comments is counted too, which only matters to files that are nearly too large.
    if (static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.end(), '<')) > 2 * limits_.nodes + 64)
      return refuse_node_count(0);
    if (static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.end(), '=')) > kMostAttributes) {
      return refuse(0, {}, fmt::format("the file has more than {} attributes", kMostAttributes), "split it into files");
    }
    return true;
  }

  bool refuse_node_count(int line) {
    return refuse(line, {}, fmt::format("the file has more than {} nodes", limits_.nodes),
                  "split it, or put geometry into .glb files");
  }

  bool parse() {
    auto spans = scan_xml(bytes_);
    if (!spans) {
      XmlFault& fault = spans.error();
      return refuse(lines_.at(static_cast<std::ptrdiff_t>(fault.offset)), std::move(fault.element),
                    "not well-formed XML: " + fault.what, std::move(fault.remedy));
    }
    spans_ = std::move(*spans);
    const auto result = xml_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_full, pugi::encoding_utf8);
    if (result) return true;
    return refuse(lines_.at(result.offset), {}, fmt::format("not well-formed XML: {}", result.description()),
                  "close what is open and quote every attribute; an XML editor shows the place");
  }

  /// Depth first with a stack of our own: a deep file must not use up the program's.
  bool copy_tree() {
    struct Open {
      pugi::xml_node next;
      NodeId parent;
    };
    std::vector<Open> open{{xml_.first_child(), NodeId::none()}};
    while (!open.empty()) {
      const pugi::xml_node from = open.back().next;
      if (!from) {
        open.pop_back();
        continue;
      }
      open.back().next = from.next_sibling();
      if (document_.nodes_.size() >= limits_.nodes) return refuse_node_count(lines_.at(from.offset_debug()));
      if (open.size() > limits_.depth) {
        return refuse(lines_.at(from.offset_debug()), from.name(),
                      fmt::format("nodes are nested more than {} deep", limits_.depth),
                      "flatten the tree; no scenario needs that depth");
      }
      const NodeId id = copy_node(from, open.back().parent);
      if (apart_) {
        return refuse(document_[id].line, document_.describe(id), "not well-formed XML: it can be read in two ways",
                      "write this element and the DOCTYPE in the plainest form");
      }
      if (metadata_bytes_ > limits_.metadata_bytes) {
        return refuse(document_[id].line, document_.describe(id),
                      fmt::format("metadata values take more than {}", megabytes(limits_.metadata_bytes)),
                      "keep recordings and data in files of their own");
      }
      if (has_entities(id)) {
        return refuse(document_[id].line, "DOCTYPE", "the file declares entities, which are never read",
                      "write the text in its place and remove <!ENTITY ...>");
      }
      if (from.first_child()) open.push_back({from.first_child(), id});
    }
    return true;
  }

  NodeId copy_node(const pugi::xml_node& from, NodeId parent) {
    const NodeId id(document_.nodes_.size());
    Node node;
    node.kind = kind_of(from.type());
    node.name = from.name();
    node.text = from.value();
    node.parent = parent;
    node.line = lines_.at(from.offset_debug());
    for (const pugi::xml_attribute& a : from.attributes())
      node.attributes.push_back({a.name(), a.value(), {}});
    if (node.kind == NodeKind::element) place(node);
    if (is_metadata(node)) {
      for (const Attribute& a : node.attributes)
        metadata_bytes_ += a.value.size();
    }
    document_.nodes_.push_back(std::move(node));
    (parent ? document_.nodes_[parent.index()].children : document_.top_).push_back(id);
    return id;
  }

  /// The parser and the scanner meet elements and attributes in the same order.
  void place(Node& node) {
    const bool known = elements_ < spans_.elements.size();
    if (known) node.span = spans_.elements[elements_++];
    apart_ = apart_ || !known || node.span.attributes != node.attributes.size();
    if (apart_) return;
    for (std::size_t i = 0; i < node.attributes.size(); ++i)
      node.attributes[i].span = spans_.attributes[node.span.first_attribute + i];
  }

  [[nodiscard]] bool has_entities(NodeId id) const {
    return document_[id].kind == NodeKind::doctype && document_[id].text.find("<!ENTITY") != std::string::npos;
  }

  bool find_scene() {
    for (const NodeId id : document_.top_) {
      if (document_[id].kind == NodeKind::element && !document_.x3d_) document_.x3d_ = id;
    }
    if (!document_.x3d_)
      return refuse(1, {}, "there is no X3D element", "begin with <X3D profile='Interactive' version='4.0'>");
    const Node& x3d = document_[document_.x3d_];
    if (x3d.name != "X3D") {
      return refuse(x3d.line, x3d.name, "the file is XML, but not X3D", "its outermost element must be X3D");
    }
    if (!check_version(x3d)) return false;
    for (const NodeId child : document_.child_elements(document_.x3d_)) {
      if (document_[child].name != "Scene") continue;
      if (document_.scene_) return refuse(document_[child].line, "Scene", "there is a second Scene", "keep one");
      document_.scene_ = child;
    }
    if (!document_.scene_) return refuse(x3d.line, "X3D", "there is no Scene", "put the nodes into <Scene>...</Scene>");
    return true;
  }

  bool check_version(const Node& x3d) {
    const std::string* version = x3d.attribute("version");
    const std::string given = version != nullptr ? *version : "";
    if (given.starts_with("4.")) return true;
    if (given.starts_with("3.")) {
      problems_.warning(x3d.line, "X3D", fmt::format("X3D {} is read as 4.0", given), "write version='4.0'");
      return true;
    }
    return refuse(x3d.line, "X3D",
                  version == nullptr ? "no version is given" : fmt::format("X3D version '{}' is not known", given),
                  "write version='4.0'");
  }

  std::string_view bytes_;
  Problems& problems_;
  const DocumentLimits& limits_;
  Lines lines_;
  XmlSpans spans_;
  std::size_t elements_ = 0;  // placed so far
  bool apart_ = false;        // scanner and parser saw different files
  pugi::xml_document xml_;
  Document document_;
  std::size_t metadata_bytes_ = 0;
};

Expected<Document> read_document(std::string_view bytes, const std::filesystem::path& path, Problems& problems,
                                 const DocumentLimits& limits) {
  return DocumentBuilder(bytes, path, problems, limits).build();
}

Expected<Document> read_document(const std::filesystem::path& path, Problems& problems, const DocumentLimits& limits) {
  std::error_code status;
  const bool is_file = std::filesystem::is_regular_file(path, status);
  std::ifstream file(path, std::ios::binary);
  if (!is_file || !file) {
    problems.error(0, {}, "the file cannot be read", "check the name and the rights");
    return tl::unexpected(problems.first_error());
  }
  // One byte more than allowed is enough to see that it is too large.
  std::string bytes(std::min<std::uintmax_t>(std::filesystem::file_size(path, status), limits.bytes + 1), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return read_document(bytes, path, problems, limits);
}

}  // namespace mechane::x3d
