// Checks elements against our own tables: ranges narrower than X3D's, fields that are not read, misplaced or misspelt sets of metadata;
// and notes, once for each type, valid nodes that are not simulated. X3D's own tables are checked first (x3d/node_check.hpp).
#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/scenario/compilation.hpp"
#include "server/x3d/event_routes.hpp"
#include "server/x3d/node_check.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::scenario {
namespace {

/// Fields of physics nodes that are ignored without a note: they tune another kind of solver, or give a bounding box.
constexpr std::string_view kQuiet =
    "bboxCenter bboxSize bboxDisplay forceOutput iterations preferAccuracy maxCorrectionSpeed autoDisable "
    "disableAngularSpeed disableLinearSpeed disableTime errorCorrection";

bool is_physics(std::string_view type) {
  return type == "RigidBody" || type == "RigidBodyCollection" || type == "SingleAxisHingeJoint" ||
         type == "SliderJoint" || type == "BallJoint";
}

/// Why a node does nothing here, and what to use instead; none for nodes that are read, or that only other readers need.
struct Aside {
  std::string_view what;
  std::string_view remedy;
};

std::optional<Aside> aside_of(const x3d::Schema& x3d, const x3d::NodeType& type) {
  if (type.name.starts_with("Metadata") || find_node_table(type.name) != nullptr) return std::nullopt;
  const auto is = [&](std::string_view base) { return x3d.is_a(type.name, base); };
  if (is("X3DRigidJointNode"))
    return Aside{"not simulated", "use SingleAxisHingeJoint, SliderJoint or BallJoint, or an agent"};
  if (is("X3DNBodyCollidableNode") || is("X3DNBodyCollisionSpaceNode") || is("CollisionCollection"))
    return Aside{"not simulated", "put a CollidableShape into the geometry of a RigidBody"};
  if (type.name == "ROUTE" || (x3d::find_event_type(type.name) != nullptr && type.name != "Transform"))
    return Aside{"not simulated, because its target is not simulated",
                 "lead it to a Transform with shapes, to a RigidBody with fixed='true', or to a node that runs"};
  if (is("X3DSensorNode") || is("X3DScriptNode") || is("X3DInterpolatorNode") || is("X3DFollowerNode") ||
      is("X3DTriggerNode") || is("X3DSequencerNode"))
    return Aside{"not simulated", "let agents, quantities and the triggers of steps do it"};
  if (is("X3DSoundNode") || is("X3DSoundSourceNode"))
    return Aside{"not played", "name the sound of a step by audio.<language> in its text"};
  if (type.name == "Transform" || type.name == "Group" || type.name == "StaticGroup" || type.name == "Switch")
    return Aside{"not applied to what it holds, and its shapes are neither drawn nor touched",
                 "put it under the Scene or one of its groups, and see that it is visible"};
  if (is("X3DShapeNode") || is("X3DGeometryNode"))
    return Aside{"neither drawn nor touched",
                 "use a Box, Sphere, Cone, Cylinder, IndexedFaceSet, IndexedTriangleSet, TriangleSet, Extrusion or "
                 "ElevationGrid, or put the shape into a mesh file"};
  if (type.is_statement()) return std::nullopt;
  if (is("X3DBindableNode") || is("X3DLightNode") || type.name == "LocalFog" || is("X3DInfoNode")) return std::nullopt;
  return Aside{"not simulated", "other X3D readers may show it"};
}

class OwnNodeChecker {
 public:
  explicit OwnNodeChecker(Compilation& c)
      : document_(c.document), shapes_(c.shapes), problems_(c.problems), x3d_(x3d::Schema::standard()) {}

  void run() {
    struct Open {
      x3d::NodeId id;
      bool quiet;  // a node around it has been noted
    };
    std::vector<Open> open{{document_.x3d(), false}};
    while (!open.empty() && !(problems_.full() && problems_.has_errors())) {
      const auto [id, quiet] = open.back();
      open.pop_back();
      const x3d::Node& node = document_[id];
      const x3d::NodeType* type = node.kind == x3d::NodeKind::element ? x3d_.find(node.name) : nullptr;
      if (type == nullptr) continue;
      check_attributes(id, *type);
      const bool noted = note_aside(id, *type, quiet);
      // Prototypes are not checked: only other readers use them.
      if (node.name == "ProtoDeclare" || node.name == "ExternProtoDeclare") continue;
      for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
        open.push_back({*child, quiet || noted});
    }
    report_asides();
  }

 private:
  void check_attributes(x3d::NodeId id, const x3d::NodeType& type) {
    const x3d::Node& node = document_[id];
    const Table* read = find_node_table(type.name);
    for (const x3d::Attribute& attribute : node.attributes) {
      const x3d::Field* field = type.field(attribute.name);
      if (field == nullptr || field->fault(attribute.value)) continue;  // reported by x3d::check_nodes()
      const Key* key = read == nullptr ? nullptr : read->find(attribute.name);
      if (const auto fault = attribute_fault(*field, key, attribute.value)) {
        problems_.error(ErrorCode::invalid_value, node.line, document_.describe(id),
                        fmt::format("{}: {}", attribute.name, fault->what), fault->remedy);
      } else if (is_physics(type.name) && key == nullptr && !one_of(attribute.name, kQuiet)) {
        note_unread(id, attribute, *field);
      }
    }
  }

  void note_unread(x3d::NodeId id, const x3d::Attribute& attribute, const x3d::Field& field) {
    std::string plain = attribute.value;
    std::replace(plain.begin(), plain.end(), ' ', ',');
    if (plain == field.default_value) return;
    problems_.note(document_[id].line, document_.describe(id), fmt::format("{} is not simulated", attribute.name),
                   "other X3D readers may use it");
  }

  /// Notes a node that does nothing here. True where it is one.
  bool note_aside(x3d::NodeId id, const x3d::NodeType& type, bool quiet) {
    if (shapes_.used().contains(document_.resolve(id))) return false;
    const std::optional<Aside> aside = aside_of(x3d_, type);
    if (!aside) return false;
    if (document_[id].used) return true;
    problems_.leave_out(1);
    if (quiet) return true;
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
  }

  struct Asides {
    std::size_t count = 0;
    x3d::NodeId first;
    Aside aside;
  };

  const x3d::Document& document_;
  const x3d::ShapeTree& shapes_;
  x3d::Problems& problems_;
  const x3d::Schema& x3d_;
  std::map<std::string_view, Asides> asides_;
};

/// The elements that each of our sets may be on.
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

/// The element that a metadata node belongs to, past all sets around it.
x3d::NodeId owner_of(const x3d::Document& document, x3d::NodeId id) {
  while (document[id].parent && document[id].name.starts_with("Metadata"))
    id = document[id].parent;
  return id;
}

/// Reports sets whose names are nearly ours, and our sets on elements where they are not read.
void check_own_sets(Compilation& c) {
  std::vector<std::string> known{"mechane"};
  for (const OwnSet& own : kOwnSets)
    known.emplace_back(own.name);
  for (const x3d::NodeId id : c.document.elements("MetadataSet")) {
    const std::string* name = c.document[id].attribute("name");
    if (name == nullptr || (!name->starts_with("mechane:") && nearest(*name, known).find(':') == std::string::npos))
      continue;
    const x3d::NodeId owner = owner_of(c.document, id);
    const std::string where = c.document.describe(owner);
    const auto own =
        std::find_if(std::begin(kOwnSets), std::end(kOwnSets), [&](const OwnSet& s) { return s.name == *name; });
    if (own == std::end(kOwnSets)) {
      c.problems.unknown(c.document[id].line, where, fmt::format("the set '{}' is not known and does nothing", *name),
                         *name, known);
    } else if (!one_of(c.document[owner].name, own->owners)) {
      c.problems.error(ErrorCode::conflict, c.document[id].line, where,
                       fmt::format("'{}' does nothing on a {}", *name, c.document[owner].name),
                       fmt::format("put it on one of: {}", own->owners));
    }
  }
}

}  // namespace

void check_nodes(Compilation& c) {
  x3d::check_nodes(c.document, c.problems);
  OwnNodeChecker(c).run();
  check_own_sets(c);
}

}  // namespace mechane::scenario
