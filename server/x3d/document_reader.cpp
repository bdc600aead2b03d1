// Bytes to a Document: the caps first, then one pass of expat that makes the tree, then DEF and USE.
#include <algorithm>
#include <fstream>
#include <memory>

#include <expat.h>
#include <fmt/format.h>

#include "server/base/assert.hpp"
#include "server/base/utf8.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/uses.hpp"
#include "server/x3d/xml_fault.hpp"

namespace mechane::x3d {
namespace {

// An attribute may take only five bytes in a file, but takes a hundred in memory.
constexpr std::size_t kMostAttributes = 1'000'000;

/// Finds the line of an offset.
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

std::string megabytes(std::size_t bytes) {
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / (1u << 20));
}

}  // namespace

/// Fills one Document. Its methods are the stages, in order; each returns false once it has added a problem.
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
    if (!check_bytes() || !parse() || !find_scene()) return tl::unexpected(problems_.first_error());
    resolve_uses(document_.nodes_, document_.defs_, problems_);
    if (problems_.has_errors()) return tl::unexpected(problems_.first_error());
    document_.source_ = std::string(bytes_);
    return std::move(document_);
  }

 private:
  bool refuse(ErrorCode code, int line, std::string node, std::string what, std::string remedy) {
    problems_.error(code, line, std::move(node), std::move(what), std::move(remedy));
    return false;
  }

  /// Checks the caps before the parser sees the file, so that the parser cannot take more memory than they allow.
  bool check_bytes() {
    if (bytes_.size() > limits_.bytes) {
      return refuse(
          ErrorCode::too_large, 0, {},
          fmt::format("the file has {}, more than the {} allowed", megabytes(bytes_.size()), megabytes(limits_.bytes)),
          "put meshes into .glb files and name them by Inline");
    }
    if (bytes_.find_first_not_of(" \t\r\n") == std::string_view::npos)
      return refuse(ErrorCode::damaged, 0, {}, "the file is empty", "write an X3D scene");
    if (const auto bad = first_bad_utf8(bytes_)) {
      return refuse(ErrorCode::damaged, lines_.at(static_cast<std::ptrdiff_t>(*bad)), {}, "the text is not UTF-8",
                    "save the file as UTF-8");
    }
    if (bytes_.starts_with("#VRML") || bytes_.starts_with("#X3D V")) {
      return refuse(ErrorCode::not_supported, 1, {}, "the file is in the encoding of VRML, not in XML",
                    "convert it: tovrmlx3d --encoding xml FILE > FILE.x3d");
    }
    // An element has one or two '<'. Those in comments are counted too, which matters only where a file is nearly too large.
    if (static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.end(), '<')) > 2 * limits_.nodes + 64)
      return refuse_node_count(0);
    if (static_cast<std::size_t>(std::count(bytes_.begin(), bytes_.end(), '=')) > kMostAttributes) {
      return refuse(ErrorCode::too_large, 0, {}, fmt::format("the file has more than {} attributes", kMostAttributes),
                    "split it into files");
    }
    return true;
  }

  bool refuse_node_count(int line) {
    return refuse(ErrorCode::too_large, line, {}, fmt::format("the file has more than {} nodes", limits_.nodes),
                  "split it, or put geometry into .glb files");
  }

  bool parse() {
    const std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser(XML_ParserCreate("UTF-8"),
                                                                              &XML_ParserFree);
    MECHANE_ASSERT(parser != nullptr);  // memory has run out
    parser_ = parser.get();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, &on_start, &on_end);
    XML_SetCharacterDataHandler(parser_, &on_text);
    XML_SetDefaultHandler(parser_, &on_other);
    XML_SetEndDoctypeDeclHandler(parser_, &on_doctype_end);
    XML_SetEntityDeclHandler(parser_, &on_entity);
    XML_SetAttlistDeclHandler(parser_, &on_attribute_list);
    XML_SetSkippedEntityHandler(parser_, &on_skipped_entity);
    const auto status = XML_Parse(parser_, bytes_.data(), static_cast<int>(bytes_.size()), XML_TRUE);
    if (refused_) return false;
    if (status == XML_STATUS_OK) return true;
    const XML_Error code = XML_GetErrorCode(parser_);
    if (code == XML_ERROR_NO_ELEMENTS && !open_ && !within_) return refuse_without_x3d();
    return refuse_as_xml(explain(bytes_, document_.nodes_, open_, {read_, here(), XML_ErrorString(code)}));
  }

  bool refuse_as_xml(XmlFault fault) {
    return refuse(ErrorCode::damaged, lines_.at(static_cast<std::ptrdiff_t>(fault.offset)), std::move(fault.element),
                  "not well-formed XML: " + fault.what, std::move(fault.remedy));
  }

  /// The beginning of what the parser reports now.
  [[nodiscard]] std::size_t here() const { return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser_)); }
  /// The end of it.
  [[nodiscard]] std::size_t there() const {
    return here() + static_cast<std::size_t>(XML_GetCurrentByteCount(parser_));
  }
  [[nodiscard]] int line_here() const { return lines_.at(static_cast<std::ptrdiff_t>(here())); }

  // Called by the parser. It may call once more after it has been stopped, for the end of an empty element.

  static DocumentBuilder* of(void* builder) {
    auto* self = static_cast<DocumentBuilder*>(builder);
    return self->refused_ ? nullptr : self;
  }

  static void XMLCALL on_start(void* builder, const XML_Char* name, const XML_Char** attributes) {
    if (auto* self = of(builder); self != nullptr) self->stop_unless(self->begin_element(name, attributes));
  }

  static void XMLCALL on_end(void* builder, const XML_Char*) {
    if (auto* self = of(builder); self != nullptr) self->stop_unless(self->end_element());
  }

  static void XMLCALL on_text(void* builder, const XML_Char* text, int length) {
    auto* self = of(builder);
    if (self == nullptr) return;
    if (self->text_.empty()) self->text_line_ = self->line_here();
    self->text_.append(text, static_cast<std::size_t>(length));
    self->pass();
  }

  /// Called for comments, instructions, blanks outside the outermost element, the ends of a CDATA section, and the pieces of a DOCTYPE.
  static void XMLCALL on_other(void* builder, const XML_Char*, int) {
    auto* self = of(builder);
    if (self == nullptr) return;
    const std::string_view markup = self->bytes_.substr(self->here());
    if (markup.starts_with("<!DOCTYPE") || markup.starts_with("<![CDATA[")) self->within_ = true;
    if (self->open_ && markup.starts_with("]]>")) self->within_ = false;
    self->pass();
  }

  static void XMLCALL on_doctype_end(void* builder) {
    auto* self = of(builder);
    if (self == nullptr) return;
    self->within_ = false;
    self->pass();
  }

  static void XMLCALL on_entity(void* builder, const XML_Char*, int, const XML_Char*, int, const XML_Char*,
                                const XML_Char*, const XML_Char*, const XML_Char*) {
    if (auto* self = of(builder); self != nullptr) {
      self->stop_unless(self->refuse(ErrorCode::not_supported, self->line_here(), "DOCTYPE",
                                     "the file declares entities, which are never read",
                                     "write the text in its place and remove <!ENTITY ...>"));
    }
  }

  /// Declared attributes are refused: their defaults would take memory for each element.
  static void XMLCALL on_attribute_list(void* builder, const XML_Char*, const XML_Char*, const XML_Char*,
                                        const XML_Char*, int) {
    if (auto* self = of(builder); self != nullptr) {
      self->stop_unless(self->refuse(ErrorCode::not_supported, self->line_here(), "DOCTYPE",
                                     "the file declares attributes, which are never read",
                                     "write them on the elements that need them, and remove <!ATTLIST ...>"));
    }
  }

  /// An entity that may be declared in the file named by the DOCTYPE: the parser skips it, so it is refused here.
  static void XMLCALL on_skipped_entity(void* builder, const XML_Char*, int) {
    auto* self = of(builder);
    if (self == nullptr || !self->open_) return;  // within the DOCTYPE itself
    self->stop_unless(self->refuse_as_xml(
        explain(self->bytes_, self->document_.nodes_, self->open_, {self->here(), self->here(), "undefined entity"})));
  }

  /// Marks what the parser reports as read, unless a DOCTYPE or CDATA section is still open.
  void pass() {
    if (!within_) read_ = there();
  }

  void stop_unless(bool good) {
    if (good) return;
    refused_ = true;
    XML_StopParser(parser_, XML_FALSE);
  }

  bool begin_element(const XML_Char* name, const XML_Char** attributes) {
    if (!take_text()) return false;
    const std::size_t begin = here();
    if (document_.nodes_.size() >= limits_.nodes) return refuse_node_count(line_here());
    if (depth_ >= limits_.depth) {
      return refuse(ErrorCode::too_large, line_here(), name,
                    fmt::format("nodes are nested more than {} deep", limits_.depth),
                    "flatten the tree; no scenario needs that depth");
    }
    auto spans = find_attributes(bytes_, begin);
    if (!spans) return refuse_as_xml(std::move(spans.error()));
    Node node;
    node.name = name;
    node.line = line_here();
    node.span.begin = static_cast<std::uint32_t>(begin);
    node.span.tag_end = static_cast<std::uint32_t>(there());
    const auto count = static_cast<std::size_t>(XML_GetSpecifiedAttributeCount(parser_)) / 2;
    // Both read the same UTF-8, and ATTLIST and entities are refused, so they agree. Should they not, it is a fault of the file.
    if (spans->size() != count) {
      return refuse(ErrorCode::damaged, node.line, name, "the tag's attributes cannot be told apart",
                    "write each as name='value', with a blank before it");
    }
    for (std::size_t i = 0; i < count; ++i)
      node.attributes.push_back({attributes[2 * i], attributes[2 * i + 1], (*spans)[i]});
    open_ = add(std::move(node));
    ++depth_;
    pass();
    return check_metadata();
  }

  bool end_element() {
    if (!take_text()) return false;
    Node& node = document_.nodes_[open_.index()];
    node.span.inner_end = static_cast<std::uint32_t>(here());
    node.span.end = static_cast<std::uint32_t>(there());
    open_ = node.parent;
    --depth_;
    pass();
    return true;
  }

  /// Adds the text between two tags as a node, unless it is blank.
  bool take_text() {
    if (text_.find_first_not_of(" \t\r\n") != std::string::npos) {
      if (document_.nodes_.size() >= limits_.nodes) return refuse_node_count(text_line_);
      Node node;
      node.kind = NodeKind::text;
      node.text = text_;
      node.line = text_line_;
      add(std::move(node));
    }
    text_.clear();
    return true;
  }

  NodeId add(Node node) {
    const NodeId id(document_.nodes_.size());
    node.parent = open_;
    if (open_) document_.nodes_[open_.index()].children.push_back(id);
    document_.nodes_.push_back(std::move(node));
    return id;
  }

  /// Counts the metadata of the element that is open against the cap.
  bool check_metadata() {
    const Node& node = document_[open_];
    if (!node.name.starts_with("Metadata")) return true;
    for (const Attribute& attribute : node.attributes)
      metadata_bytes_ += attribute.value.size();
    if (metadata_bytes_ <= limits_.metadata_bytes) return true;
    return refuse(ErrorCode::too_large, node.line, document_.describe(open_),
                  fmt::format("metadata values take more than {}", megabytes(limits_.metadata_bytes)),
                  "keep recordings and data in files of their own");
  }

  bool refuse_without_x3d() {
    return refuse(ErrorCode::missing, 1, {}, "there is no X3D element",
                  "begin with <X3D profile='Interactive' version='4.0'>");
  }

  bool find_scene() {
    document_.x3d_ = NodeId(0);
    const Node& x3d = document_[document_.x3d_];
    if (x3d.name != "X3D") {
      return refuse(ErrorCode::invalid_value, x3d.line, x3d.name, "the file is XML, but not X3D",
                    "its outermost element must be X3D");
    }
    if (!check_version(x3d)) return false;
    for (const NodeId child : document_.child_elements(document_.x3d_)) {
      if (document_[child].name != "Scene") continue;
      if (document_.scene_)
        return refuse(ErrorCode::duplicate, document_[child].line, "Scene", "there is a second Scene", "keep one");
      document_.scene_ = child;
    }
    if (!document_.scene_)
      return refuse(ErrorCode::missing, x3d.line, "X3D", "there is no Scene", "put the nodes into <Scene>...</Scene>");
    return true;
  }

  bool check_version(const Node& x3d) {
    const std::string* version = x3d.attribute("version");
    const std::string given = version != nullptr ? *version : "";
    if (given.starts_with("4.")) return true;
    if (given.starts_with("3.")) {
      problems_.warning(ErrorCode::wrong_version, x3d.line, "X3D", fmt::format("X3D {} is read as 4.0", given),
                        "write version='4.0'");
      return true;
    }
    return refuse(version == nullptr ? ErrorCode::missing : ErrorCode::wrong_version, x3d.line, "X3D",
                  version == nullptr ? "no version is given" : fmt::format("X3D version '{}' is not known", given),
                  "write version='4.0'");
  }

  std::string_view bytes_;
  Problems& problems_;
  const DocumentLimits& limits_;
  Lines lines_;
  XML_Parser parser_ = nullptr;  // while it reads
  bool refused_ = false;         // a problem says why
  bool within_ = false;          // within a DOCTYPE or a CDATA section, which come in pieces
  std::size_t read_ = 0;         // the end of what could be read
  NodeId open_;                  // the innermost element that is not closed
  std::size_t depth_ = 0;
  std::string text_;  // since the last tag
  int text_line_ = 0;
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
    const bool exists = std::filesystem::exists(path, status);
    problems.error(exists ? ErrorCode::io_failure : ErrorCode::not_found, 0, {}, "the file cannot be read",
                   "check the name and the rights");
    return tl::unexpected(problems.first_error());
  }
  // One byte more than allowed is enough to see that it is too large.
  std::string bytes(std::min<std::uintmax_t>(std::filesystem::file_size(path, status), limits.bytes + 1), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return read_document(bytes, path, problems, limits);
}

}  // namespace mechane::x3d
