// Every element held against X3D's schema and ours: types, attributes, values, and which field of its parent it fills; and, once a
// type, what of a right file is not simulated.
#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/scenario/x3d_schema.hpp"

namespace mechane::scenario {
namespace {

/// Attributes that every element may have.
constexpr std::string_view kEverywhere = "DEF USE class id style containerField xmlns";
/// Fields of physics nodes that tune a solver of another kind, or a bounding box: nobody misses them.
constexpr std::string_view kQuiet =
    "bboxCenter bboxSize bboxDisplay forceOutput iterations preferAccuracy maxCorrectionSpeed autoDisable "
    "disableAngularSpeed disableLinearSpeed disableTime errorCorrection";

bool is_metadata(std::string_view type) {
  return type.starts_with("Metadata");
}

bool is_physics(std::string_view type) {
  return type == "RigidBody" || type == "RigidBodyCollection" || type == "SingleAxisHingeJoint" ||
         type == "SliderJoint" || type == "BallJoint";
}

/// Why a node does nothing here, and what does instead; nothing for nodes that we read, or that only other readers need.
struct Aside {
  std::string_view what;
  std::string_view remedy;
};

std::optional<Aside> aside_of(const X3dSchema& x3d, const X3dType& type) {
  if (find_node_table(type.name) != nullptr) return std::nullopt;
  const auto is = [&](std::string_view base) { return x3d.is_a(type.name, base); };
  if (is("X3DRigidJointNode"))
    return Aside{"not simulated", "use SingleAxisHingeJoint, SliderJoint or BallJoint, or an agent"};
  if (is("X3DNBodyCollidableNode") || is("X3DNBodyCollisionSpaceNode") || is("CollisionCollection"))
    return Aside{"not simulated", "bodies are touched by their meshes: name a model in mechane:body"};
  if (is("CollisionSensor") || type.name == "ROUTE" || is("X3DSensorNode") || is("X3DScriptNode") ||
      is("X3DInterpolatorNode") || is("X3DFollowerNode") || is("X3DTriggerNode") || is("X3DSequencerNode"))
    return Aside{"not simulated", "let agents, quantities and the triggers of steps do it"};
  if (is("X3DSoundNode") || is("X3DSoundSourceNode"))
    return Aside{"not played", "name the sound of a step by audio.<language> in its text"};
  if (type.name == "Transform" || type.name == "Group" || type.name == "StaticGroup" || type.name == "Switch")
    return Aside{"not applied to what it holds, and its shapes are neither drawn nor touched",
                 "give bodies their own position, and shapes by a mesh file"};
  if (is("X3DShapeNode") || is("X3DGeometryNode"))
    return Aside{"neither drawn nor touched", "put shapes into a mesh file, and name it by an Inline"};
  if (type.is_statement() || is_metadata(type.name)) return std::nullopt;
  if (is("X3DBindableNode") || is("X3DLightNode") || type.name == "LocalFog" || is("X3DInfoNode")) return std::nullopt;
  return Aside{"not simulated", "other X3D readers may show it"};
}

/// Where a node that stands wrong likely belongs; the first that fits.
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
  explicit NodeChecker(Compilation& c)
      : document_(c.document), problems_(c.problems), x3d_(X3dSchema::standard()), names_(x3d_.names()) {}

  void run() {
    struct Open {
      NodeId id;
      bool quiet;  // a node above it has been noted
    };
    std::vector<Open> open{{document_.x3d(), false}};
    while (!open.empty() && !(problems_.full() && problems_.has_errors())) {
      const auto [id, quiet] = open.back();
      open.pop_back();
      const Node& node = document_[id];
      if (node.kind == NodeKind::text || node.kind == NodeKind::cdata) check_text(node);
      if (node.kind != NodeKind::element || node.name.find(':') != std::string::npos) continue;
      const X3dType* type = x3d_.find(node.name);
      if (type == nullptr) {
        problems_.unknown(node.line, document_.describe(id),
                          fmt::format("X3D has no element <{}>, and it does nothing", node.name), node.name, names_);
        continue;
      }
      check_attributes(id, *type);
      check_place(id, *type);
      const bool noted = note_aside(id, *type, quiet);
      // A prototype's fields and body are text for other readers.
      if (node.name == "ProtoDeclare" || node.name == "ExternProtoDeclare") continue;
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, quiet || noted});
    }
    report_asides();
  }

 private:
  /// X3D's text stands in attributes.
  void check_text(const Node& node) {
    const Node& parent = document_[node.parent];
    const X3dType* type = x3d_.find(parent.name);
    const bool holds_source = type != nullptr && type->field("url") != nullptr;
    if (holds_source || parent.name == "field" || parent.name == "fieldValue") return;
    const std::size_t begin = std::min(node.text.find_first_not_of(" \t\r\n"), node.text.size());
    if (begin == node.text.size()) return;
    const auto lines = std::count(node.text.begin(), node.text.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
    problems_.warning(node.line + static_cast<int>(lines), document_.describe(node.parent),
                      fmt::format("the text '{}' between elements does nothing", node.text.substr(begin, 30)),
                      "remove it, or write it as a comment: <!-- ... -->");
  }

  void check_attributes(NodeId id, const X3dType& type) {
    const Node& node = document_[id];
    const Table* read = find_node_table(type.name);
    for (const Attribute& attribute : node.attributes) {
      if (one_of(attribute.name, kEverywhere) || attribute.name.find(':') != std::string::npos) continue;
      const X3dField* field = type.field(attribute.name);
      if (field == nullptr) {
        unknown_attribute(id, type, attribute.name);
        continue;
      }
      if (is_metadata(type.name) && attribute.name == "value") continue;  // read_metadata checks it, with its name
      const Key* key = read == nullptr ? nullptr : read->find(attribute.name);
      if (const auto fault = attribute_fault(*field, key, attribute.value)) {
        problems_.error(node.line, document_.describe(id), fmt::format("{}: {}", attribute.name, fault->what),
                        fault->remedy);
      } else if (is_physics(type.name) && key == nullptr && !one_of(attribute.name, kQuiet)) {
        note_unread(id, attribute, *field);
      }
    }
  }

  void unknown_attribute(NodeId id, const X3dType& type, const std::string& name) {
    std::vector<std::string> known;
    for (const X3dField& field : type.fields)
      known.emplace_back(field.name);
    for (const char* common : {"DEF", "USE", "containerField"})
      known.emplace_back(common);
    problems_.unknown(document_[id].line, document_.describe(id),
                      fmt::format("a {} has no attribute '{}', and it does nothing", type.name, name), name, known);
  }

  void note_unread(NodeId id, const Attribute& attribute, const X3dField& field) {
    std::string plain = attribute.value;
    std::replace(plain.begin(), plain.end(), ' ', ',');
    if (plain == field.default_value) return;
    problems_.note(document_[id].line, document_.describe(id), fmt::format("{} is not simulated", attribute.name),
                   "other X3D readers may use it");
  }

  /// Which field of its parent the element fills.
  void check_place(NodeId id, const X3dType& type) {
    const Node& node = document_[id];
    if (!node.parent) return;
    const X3dType* parent = x3d_.find(document_[node.parent].name);
    if (parent == nullptr) return;
    if (is_metadata(type.name)) return check_metadata_place(id, *parent);
    if (parent->is_statement() && parent->name != "Scene") return;
    if (type.container.empty() || type.name == "ProtoInstance") return;
    std::vector<std::string> fitting;
    for (const X3dSlot& slot : parent->slots) {
      if (x3d_.accepts(slot, type.name)) fitting.emplace_back(slot.name);
    }
    const std::string* written = node.attribute("containerField");
    const std::string field = written != nullptr ? *written : std::string(type.container);
    if (std::find(fitting.begin(), fitting.end(), field) != fitting.end()) return;
    if (fitting.empty()) return misplaced(id, type, *parent);
    const std::string remedy = fmt::format("write containerField='{}'", fmt::join(fitting, "' or '"));
    if (written != nullptr) {
      problems_.error(node.line, document_.describe(id),
                      fmt::format("containerField='{}': a {} has no such field for a {}", field.substr(0, 80),
                                  parent->name, type.name),
                      remedy);
    } else if (fitting.size() > 1) {
      problems_.error(node.line, document_.describe(id),
                      fmt::format("it is not said which field of the {} it fills", parent->name), remedy);
    } else {
      problems_.warning(
          node.line, document_.describe(id),
          fmt::format("without containerField other readers do not see what it is to the {}", parent->name), remedy);
    }
  }

  void misplaced(NodeId id, const X3dType& type, const X3dType& parent) {
    std::vector<std::string> holders;
    for (const Home& home : kHomes) {
      if (holders.empty() && x3d_.is_a(type.name, home.type)) holders.emplace_back(home.holder);
    }
    for (const std::string& name : names_) {
      const std::vector<X3dSlot>& slots = x3d_.find(name)->slots;
      const auto takes = [&](const X3dSlot& slot) {
        return std::find(slot.accepts.begin(), slot.accepts.end(), type.name) != slot.accepts.end();
      };
      if (holders.empty() && std::any_of(slots.begin(), slots.end(), takes)) holders.push_back(name);
    }
    problems_.error(
        document_[id].line, document_.describe(id), fmt::format("a {} cannot stand in a {}", type.name, parent.name),
        holders.empty() ? std::string("move it out; an end tag before it may be missing")
                        : fmt::format("move it into a {}; an end tag before it may be missing", holders.front()));
  }

  void check_metadata_place(NodeId id, const X3dType& parent) {
    const Node& node = document_[id];
    const std::string wanted = parent.name == "MetadataSet" ? "value" : "metadata";
    const std::string* written = node.attribute("containerField");
    if (written == nullptr) {
      if (++unsaid_ == 1) first_unsaid_ = id;
      return;
    }
    if (*written == wanted || *written == "metadata") return;
    problems_.error(
        node.line, document_.describe(id),
        fmt::format("containerField='{}' is wrong for metadata of a {}", written->substr(0, 80), parent.name),
        fmt::format("write containerField='{}'", wanted));
  }

  /// True where the node is left aside.
  bool note_aside(NodeId id, const X3dType& type, bool quiet) {
    const std::optional<Aside> aside = aside_of(x3d_, type);
    if (!aside) return false;
    if (quiet || document_[id].used) return true;
    Asides& of_type = asides_[type.name];
    if (of_type.count++ == 0) of_type.first = id;
    of_type.aside = *aside;
    return true;
  }

  void report_asides() {
    for (const auto& [name, of_type] : asides_) {
      const std::string more = of_type.count == 1 ? "" : fmt::format(" (and {} more {})", of_type.count - 1, name);
      problems_.note(document_[of_type.first].line, document_.describe(of_type.first),
                     fmt::format("it is {}{}", of_type.aside.what, more), std::string(of_type.aside.remedy));
    }
    if (unsaid_ == 0) return;
    problems_.warning(document_[first_unsaid_].line, document_.describe(first_unsaid_),
                      fmt::format("{} metadata node{} without containerField: readers differ in what they are", unsaid_,
                                  unsaid_ == 1 ? " is" : "s are"),
                      "write containerField='metadata' on a node's own set, and 'value' inside a set");
  }

  struct Asides {
    std::size_t count = 0;
    NodeId first;
    Aside aside;
  };

  const Document& document_;
  Problems& problems_;
  const X3dSchema& x3d_;
  std::vector<std::string> names_;
  std::map<std::string_view, Asides> asides_;
  std::size_t unsaid_ = 0;
  NodeId first_unsaid_;
};

/// Where each of our sets may stand.
struct OwnSet {
  std::string_view name;
  std::string_view owners;
};
constexpr OwnSet kOwnSets[] = {
    {"mechane:scenario", "WorldInfo"},
    {"mechane:body", "RigidBody"},
    {"mechane:haptic", "RigidBody"},
    {"mechane:agent", "RigidBody SingleAxisHingeJoint SliderJoint BallJoint"},
};

/// The element that a metadata node belongs to: not a set around it.
NodeId owner_of(const Document& document, NodeId id) {
  while (document[id].parent && is_metadata(document[id].name))
    id = document[id].parent;
  return id;
}

/// Names that begin as ours do, and are not; and ours where nobody reads them.
void check_own_sets(Compilation& c) {
  std::vector<std::string> known{"mechane"};
  for (const OwnSet& own : kOwnSets)
    known.emplace_back(own.name);
  for (const NodeId id : c.document.elements("MetadataSet")) {
    const std::string* name = c.document[id].attribute("name");
    if (name == nullptr || (!name->starts_with("mechane:") && nearest(*name, known).find(':') == std::string::npos))
      continue;
    const NodeId owner = owner_of(c.document, id);
    const std::string where = c.document.describe(owner);
    const auto own =
        std::find_if(std::begin(kOwnSets), std::end(kOwnSets), [&](const OwnSet& s) { return s.name == *name; });
    if (own == std::end(kOwnSets)) {
      c.problems.unknown(c.document[id].line, where, fmt::format("there is no set '{}', and it does nothing", *name),
                         *name, known);
    } else if (!one_of(c.document[owner].name, own->owners)) {
      c.problems.error(c.document[id].line, where,
                       fmt::format("'{}' does nothing on a {}", *name, c.document[owner].name),
                       fmt::format("put it on one of: {}", own->owners));
    }
  }
}

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

void check_routes(Compilation& c) {
  const std::set<std::string> imported = imported_names(c.document);
  const std::vector<std::string> defs = c.document.defs("");
  for (const NodeId id : c.document.elements("ROUTE")) {
    const Node& route = c.document[id];
    for (const char* end : {"fromNode", "toNode"}) {
      const std::string* name = route.attribute(end);
      if (name == nullptr) {
        c.problems.error(route.line, "ROUTE", fmt::format("{} is missing", end), "name a DEF");
      } else if (!c.document.find_def(*name) && !imported.contains(*name)) {
        c.problems.error(route.line, "ROUTE", fmt::format("{}: no element has the DEF '{}'", end, name->substr(0, 80)),
                         suggest(*name, defs, "give an element that DEF"));
      }
    }
  }
}

}  // namespace

void check_nodes(Compilation& c) {
  NodeChecker(c).run();
  check_own_sets(c);
  check_routes(c);
}

}  // namespace mechane::scenario
