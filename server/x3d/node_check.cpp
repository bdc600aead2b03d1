#include "server/x3d/node_check.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/x3d/event_routes.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::x3d {
namespace {

/// Attributes that every element may have.
constexpr std::array<std::string_view, 7> kEverywhere{"DEF", "USE", "class", "id", "style", "containerField", "xmlns"};

bool is_metadata(std::string_view type) {
  return type.starts_with("Metadata");
}

/// Where a misplaced node likely belongs; the first that fits.
struct Home {
  std::string_view type;
  std::string_view holder;
};
constexpr Home kHomes[] = {{"X3DRigidJointNode", "RigidBodyCollection"},
                           {"RigidBody", "RigidBodyCollection"},
                           {"X3DGeometryNode", "Shape"},
                           {"X3DAppearanceNode", "Shape"},
                           {"X3DAppearanceChildNode", "Appearance"},
                           {"X3DChildNode", "Scene"}};

class NodeChecker {
 public:
  NodeChecker(const Document& document, Problems& problems)
      : document_(document), problems_(problems), x3d_(Schema::standard()), names_(x3d_.names()) {}

  void run() {
    std::vector<NodeId> open{document_.x3d()};
    while (!open.empty() && !(problems_.full() && problems_.has_errors())) {
      const NodeId id = open.back();
      open.pop_back();
      const Node& node = document_[id];
      if (node.kind == NodeKind::text) check_text(node);
      if (node.kind != NodeKind::element || node.name.find(':') != std::string::npos) continue;
      const NodeType* type = x3d_.find(node.name);
      if (type == nullptr) {
        problems_.unknown(node.line, document_.describe(id),
                          fmt::format("X3D has no element <{}>, and it does nothing", node.name), node.name, names_);
        continue;
      }
      check_attributes(id, *type);
      check_place(id, *type);
      // Prototypes are not checked: only other readers use them.
      if (node.name == "ProtoDeclare" || node.name == "ExternProtoDeclare") continue;
      open.insert(open.end(), node.children.rbegin(), node.children.rend());
    }
    report_unwritten();
  }

 private:
  /// X3D writes its text in attributes; text between elements is likely a mistake.
  void check_text(const Node& node) {
    const Node& parent = document_[node.parent];
    const NodeType* type = x3d_.find(parent.name);
    const bool holds_source = type != nullptr && type->field("url") != nullptr;
    if (holds_source || parent.name == "field" || parent.name == "fieldValue") return;
    const std::size_t begin = std::min(node.text.find_first_not_of(" \t\r\n"), node.text.size());
    if (begin == node.text.size()) return;
    const auto lines = std::count(node.text.begin(), node.text.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    problems_.warning(ErrorCode::not_supported, node.line + static_cast<int>(lines), document_.describe(node.parent),
                      fmt::format("the text '{}' between elements does nothing", node.text.substr(begin, 30)),
                      "remove it, or write it as a comment: <!-- ... -->");
  }

  void check_attributes(NodeId id, const NodeType& type) {
    const Node& node = document_[id];
    for (const Attribute& attribute : node.attributes) {
      const bool common = std::find(kEverywhere.begin(), kEverywhere.end(), attribute.name) != kEverywhere.end();
      if (common || attribute.name.find(':') != std::string::npos) continue;
      const Field* field = type.field(attribute.name);
      if (field == nullptr) {
        unknown_attribute(id, type, attribute.name);
        continue;
      }
      if (is_metadata(type.name) && attribute.name == "value") continue;  // read_metadata checks it, with its name
      if (const auto fault = field->fault(attribute.value)) {
        problems_.error(ErrorCode::invalid_value, node.line, document_.describe(id),
                        fmt::format("{}: {}", attribute.name, fault->what), fault->remedy);
      }
    }
  }

  void unknown_attribute(NodeId id, const NodeType& type, const std::string& name) {
    std::vector<std::string> known;
    for (const Field& field : type.fields)
      known.emplace_back(field.name);
    for (const char* common : {"DEF", "USE", "containerField"})
      known.emplace_back(common);
    problems_.unknown(document_[id].line, document_.describe(id),
                      fmt::format("a {} has no attribute '{}', and it does nothing", type.name, name), name, known);
  }

  /// Checks which field of its parent the element fills.
  void check_place(NodeId id, const NodeType& type) {
    const Node& node = document_[id];
    if (!node.parent) return;
    const NodeType* parent = x3d_.find(document_[node.parent].name);
    if (parent == nullptr) return;
    if (is_metadata(type.name)) return check_metadata_place(id, *parent);
    if (parent->is_statement() && parent->name != "Scene") return;
    if (type.container.empty() || type.name == "ProtoInstance") return;
    std::vector<std::string> fitting;
    for (const Slot& slot : parent->slots) {
      if (x3d_.accepts(slot, type.name)) fitting.emplace_back(slot.name);
    }
    const std::string* written = node.attribute("containerField");
    const std::string field = written != nullptr ? *written : std::string(type.container);
    if (std::find(fitting.begin(), fitting.end(), field) != fitting.end()) return;
    if (fitting.empty()) return misplaced(id, type, *parent);
    const std::string remedy = fmt::format("write containerField='{}'", fmt::join(fitting, "' or '"));
    if (written != nullptr) {
      problems_.error(ErrorCode::conflict, node.line, document_.describe(id),
                      fmt::format("containerField='{}': a {} has no such field for a {}", field.substr(0, 80),
                                  parent->name, type.name),
                      remedy);
    } else if (fitting.size() > 1) {
      problems_.error(
          ErrorCode::missing, node.line, document_.describe(id),
          fmt::format("the containerField is missing, and the {} has several fields for a {}", parent->name, type.name),
          remedy);
    } else {
      problems_.warning(
          ErrorCode::missing, node.line, document_.describe(id),
          fmt::format("the containerField is missing: other readers cannot tell which field of the {} it fills",
                      parent->name),
          remedy);
    }
  }

  void misplaced(NodeId id, const NodeType& type, const NodeType& parent) {
    std::vector<std::string> holders;
    for (const Home& home : kHomes) {
      if (holders.empty() && x3d_.is_a(type.name, home.type)) holders.emplace_back(home.holder);
    }
    for (const std::string& name : names_) {
      const std::vector<Slot>& slots = x3d_.find(name)->slots;
      const auto takes = [&](const Slot& slot) {
        return std::find(slot.accepts.begin(), slot.accepts.end(), type.name) != slot.accepts.end();
      };
      if (holders.empty() && std::any_of(slots.begin(), slots.end(), takes)) holders.push_back(name);
    }
    problems_.error(ErrorCode::conflict, document_[id].line, document_.describe(id),
                    fmt::format("a {} cannot stand in a {}", type.name, parent.name),
                    holders.empty()
                        ? std::string("move it out; an end tag before it may be missing")
                        : fmt::format("move it into a {}; an end tag before it may be missing", holders.front()));
  }

  void check_metadata_place(NodeId id, const NodeType& parent) {
    const Node& node = document_[id];
    const std::string wanted = parent.name == "MetadataSet" ? "value" : "metadata";
    const std::string* written = node.attribute("containerField");
    if (written == nullptr) {
      if (++unwritten_ == 1) first_unwritten_ = id;
      return;
    }
    if (*written == wanted || *written == "metadata") return;
    problems_.error(
        ErrorCode::conflict, node.line, document_.describe(id),
        fmt::format("containerField='{}' is wrong for metadata of a {}", written->substr(0, 80), parent.name),
        fmt::format("write containerField='{}'", wanted));
  }

  void report_unwritten() {
    if (unwritten_ == 0) return;
    problems_.warning(ErrorCode::missing, document_[first_unwritten_].line, document_.describe(first_unwritten_),
                      fmt::format("{} metadata node{} without containerField: X3D readers treat {} differently",
                                  unwritten_, unwritten_ == 1 ? " is" : "s are", unwritten_ == 1 ? "it" : "them"),
                      "write containerField='metadata' on a node's own set, and 'value' inside a set");
  }

  const Document& document_;
  Problems& problems_;
  const Schema& x3d_;
  std::vector<std::string> names_;
  std::size_t unwritten_ = 0;
  NodeId first_unwritten_;
};

/// Names that an IMPORT gives to nodes of another file.
std::set<std::string> imported_names(const Document& document) {
  std::set<std::string> names;
  for (const NodeId id : document.elements("IMPORT")) {
    const std::string* as = document[id].attribute("AS");
    if (as == nullptr) as = document[id].attribute("importedDEF");
    if (as != nullptr) names.insert(*as);
  }
  return names;
}

void check_routes(const Document& document, Problems& problems) {
  const std::set<std::string> imported = imported_names(document);
  const std::vector<std::string> defs = document.defs("");
  for (const NodeId id : document.elements("ROUTE")) {
    const Node& route = document[id];
    for (const char* end : {"fromNode", "toNode"}) {
      const std::string* name = route.attribute(end);
      if (name == nullptr) {
        problems.error(ErrorCode::missing, route.line, "ROUTE", fmt::format("{} is missing", end),
                       "write the DEF of an element");
      } else if (!document.find_def(*name) && !imported.contains(*name)) {
        problems.error(ErrorCode::unknown_name, route.line, "ROUTE",
                       fmt::format("{}: no element has the DEF '{}'", end, name->substr(0, 80)),
                       suggest(*name, defs, "give an element that DEF"));
      }
    }
    if (const auto fault = route_fault(document, id))
      problems.error(ErrorCode::conflict, route.line, "ROUTE", fault->what, fault->remedy);
  }
}

}  // namespace

void check_nodes(const Document& document, Problems& problems) {
  NodeChecker(document, problems).run();
  check_routes(document, problems);
}

}  // namespace mechane::x3d
