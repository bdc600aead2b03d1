#include "client-sdk/studio/edits/body_edits.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "client-sdk/authoring/rename.hpp"
#include "client-sdk/authoring/text_edits.hpp"
#include "client-sdk/studio/edits/node_text.hpp"
#include "client-sdk/studio/edits/parts.hpp"
#include "server/base/suggestion.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/node_fields.hpp"
#include "server/x3d/schema.hpp"
#include "server/x3d/shape_tree.hpp"

namespace mechane::studio {
namespace {

using authoring::TextEdits;
using x3d::Document;
using x3d::NodeId;

constexpr double kCopyBeside_m = 0.3;

std::string attribute_of(const Document& document, NodeId id, std::string_view name) {
  const std::string* value = document[id].attribute(name);
  return value == nullptr ? std::string() : *value;
}

std::string source_of(const Document& document, NodeId id) {
  const x3d::ElementSpan& span = document[id].span;
  return document.source().substr(span.begin, span.end - span.begin);
}

/// All elements under one, itself included.
void gather(const Document& document, NodeId id, std::vector<NodeId>& out) {
  out.push_back(id);
  for (const NodeId child : document.child_elements(id))
    gather(document, child, out);
}

/// All elements that use the node, and itself.
std::vector<NodeId> uses_of(const Document& document, NodeId node) {
  std::vector<NodeId> out;
  for (std::size_t i = 0; i < document.size(); ++i) {
    const NodeId id(i);
    if (document[id].kind == x3d::NodeKind::element && document.resolve(id) == node) out.push_back(id);
  }
  return out;
}

using Attributes = std::vector<std::pair<std::string_view, std::string>>;

/// Copies elements: without USE of collidables, and with new DEFs.
class Copier {
 public:
  explicit Copier(const Document& document) : document_(document), taken_(authoring::names_of_file(document).things) {}

  /// The text of a copy, whose own attributes are changed so.
  std::string copy(NodeId id, const Attributes& changes) {
    const NodeId source = document_.resolve(id);
    TextEdits edits;
    for (const auto& [name, value] : changes)
      set_in(source, name, value, edits);
    edit(source, document_[source].span.begin, edits);
    return edits.apply(source_of(document_, source));
  }
  [[nodiscard]] std::string fresh(const std::string& name) {
    if (taken_.insert(name).second) return name;
    for (int number = 2;; ++number)
      if (auto next = fmt::format("{}_{}", name, number); taken_.insert(next).second) return next;
  }
  /// The new DEFs, the copy's own first.
  [[nodiscard]] const std::vector<std::string>& named() const { return named_; }

 private:
  void set_in(NodeId source, std::string_view name, const std::string& value, TextEdits& edits) const {
    const x3d::Node& node = document_[source];
    const std::size_t begin = node.span.begin;
    for (const x3d::Attribute& attribute : node.attributes)
      if (attribute.name == name)
        return edits.replace(attribute.span.value_begin - begin, attribute.span.value_end - begin, value);
    const std::size_t at =
        node.attributes.empty() ? 1 + node.name.size() : node.attributes.back().span.value_end + 1 - begin;
    edits.insert(at, fmt::format(" {}='{}'", name, value));
  }
  /// Gives new DEFs, and writes collidables out that are used: two bodies must not share one.
  void edit(NodeId source, std::size_t begin, TextEdits& edits) {
    for (const x3d::Attribute& attribute : document_[source].attributes) {
      if (attribute.name != "DEF") continue;
      named_.push_back(fresh(attribute.value));
      edits.replace(attribute.span.value_begin - begin, attribute.span.value_end - begin, named_.back());
    }
    for (const NodeId child : document_.child_elements(source)) {
      const x3d::ElementSpan& span = document_[child].span;
      if (!document_[child].used) {
        edit(child, begin, edits);
      } else if (is_collidable(document_, child)) {
        const std::string field = document_.container_field(child, "geometry");
        edits.replace(span.begin - begin, span.end - begin, copy(child, {{"containerField", field}}));
      }
    }
  }

  const Document& document_;
  std::set<std::string> taken_;
  std::vector<std::string> named_;
};

void remove_routes(const Document& document, const std::set<std::string>& defs, TextEdits& edits) {
  for (std::size_t i = 0; i < document.size(); ++i) {
    const NodeId id(i);
    if (document[id].name != "ROUTE") continue;
    if (defs.contains(attribute_of(document, id, "fromNode")) || defs.contains(attribute_of(document, id, "toNode")))
      authoring::remove_element(document, id, edits);
  }
}

/// The collidables that a body's geometry uses and no other body does.
std::vector<NodeId> own_collidables(const Document& document, NodeId body) {
  std::vector<NodeId> out;
  for (const NodeId child : document.child_elements(body)) {
    const NodeId collidable = document.resolve(child);
    if (document.container_field(child, "") != "geometry" || collidable == child) continue;
    const auto uses = uses_of(document, collidable);
    const auto of_others = [&](NodeId use) {
      const NodeId parent = document[use].parent;
      return parent && document[parent].name == "RigidBody" && parent != body;
    };
    if (std::none_of(uses.begin(), uses.end(), of_others)) out.push_back(collidable);
  }
  return out;
}

std::vector<NodeId> joints_of(const Document& document, NodeId body) {
  std::vector<NodeId> out;
  for (const NodeId use : uses_of(document, body)) {
    const NodeId parent = document[use].parent;
    if (parent && is_joint(document, parent)) out.push_back(parent);
  }
  return out;
}

/// Into the first RigidBodyCollection. A file without one gets one.
void append_body(const Document& document, const std::string& text, TextEdits& edits) {
  if (const auto collections = document.elements("RigidBodyCollection"); !collections.empty()) {
    const NodeId into = collections.front();
    return authoring::append_inside(document, into, with_margin(text, authoring::inner_margin_of(document, into)),
                                    edits);
  }
  const std::string margin = authoring::inner_margin_of(document, document.scene());
  const std::string line = margin.empty() ? "\n" : margin;
  authoring::append_inside(document, document.scene(),
                           line + "<RigidBodyCollection gravity='0 -9.81 0'>" + with_margin(text, line + "  ") + line +
                               "</RigidBodyCollection>",
                           edits);
}

/// The DEF of the Inline of a file; empty if no Inline names the file.
std::string inline_of(const Document& document, const std::string& url) {
  for (const NodeId id : document.elements("Inline")) {
    const auto urls = x3d::NodeFields(document, id).strings("url");
    if (!urls.empty() && urls.front() == url && !attribute_of(document, id, "DEF").empty())
      return attribute_of(document, id, "DEF");
  }
  return {};
}

constexpr std::string_view kMeshBody = R"(<RigidBody DEF='{}' mass='{}' position='{}'>
  <MetadataSet containerField='metadata' name='mechane'>
    <MetadataSet containerField='value' name='mechane:body'>
      <MetadataString containerField='value' name='model' value='{}'/>
      <MetadataString containerField='value' name='node' value='{}'/>
    </MetadataSet>
    <MetadataSet containerField='value' name='mechane:haptic'>
      <MetadataDouble containerField='value' name='effortScale' value='0.2'/>
      <MetadataBoolean containerField='value' name='graspable' value='true'/>
    </MetadataSet>
  </MetadataSet>
</RigidBody>)";

std::string mesh_body(const InsertMesh& insert, const std::string& name, const std::string& model) {
  const auto quoted = [](const std::string& text) {
    return authoring::escape_attribute(authoring::quote_strings({text}));
  };
  return fmt::format(kMeshBody, name, in_words(insert.mass_kg), in_words(insert.p_WB), quoted(model),
                     quoted(insert.node));
}

/// Writes a pose in W into two fields of a node.
Expected<void> place(const Document& document, NodeId id, const Pose& X_WB, bool in_world, TextEdits& edits) {
  const bool transform = document[id].name == "Transform";
  Pose X = X_WB;
  if (!in_world) {
    const auto around = x3d::frame_around(document, id);
    if (!around)
      return fail(ErrorCode::not_supported, fmt::format("{} stands in a scaled group", document.describe(id)),
                  Place(document.describe(id), document[id].line), "move it in the file");
    X = around->inverse() * X_WB;
  }
  authoring::set_attribute(document, id, transform ? "translation" : "position", in_words(X.p), edits);
  const std::string_view turn = transform ? "rotation" : "orientation";
  const x3d::NodeFields fields(document, id);
  // What is not turned, and was not, needs no rotation in the file.
  if (fields.rotation(turn).angularDistance(X.R) > 1e-7)
    authoring::set_attribute(document, id, turn, in_words(X.R), edits);
  return {};
}

}  // namespace

bool is_joint(const Document& document, NodeId id) {
  return x3d::Schema::standard().is_a(document[id].name, "X3DRigidJointNode");
}

bool is_collidable(const Document& document, NodeId id) {
  return x3d::Schema::standard().is_a(document[id].name, "X3DNBodyCollidableNode");
}

bool is_new_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '-'; };
  return !name.empty() && name.size() <= 60 && letter(name.front()) && std::all_of(name.begin(), name.end(), inner);
}

tl::unexpected<Error> no_new_name(const std::string& name) {
  return fail(ErrorCode::invalid_value, fmt::format("'{}' cannot be a name", name), "",
              "take letters a-z, digits, '-' and '_', 60 at most, with a letter first");
}

std::string free_name(const Document& document, const std::string& name) {
  return Copier(document).fresh(name);
}

Expected<Grown> with_part(const Document& document, const InsertPart& insert) {
  const Part* part = find_part(insert.part);
  if (part == nullptr)
    return fail(ErrorCode::unknown_name, fmt::format("the library has no part '{}'", insert.part), "",
                suggest(insert.part, part_names(), ""));
  if (!insert.name.empty() && !is_new_name(insert.name)) return no_new_name(insert.name);
  const std::string name = free_name(document, insert.name.empty() ? std::string(part->def) : insert.name);
  TextEdits edits;
  append_body(document, text_of(*part, name, in_words(insert.p_WB)), edits);
  return Grown{edits.apply(document.source()), name};
}

Expected<Grown> with_mesh(const Document& document, const InsertMesh& insert) {
  if (!insert.name.empty() && !is_new_name(insert.name)) return no_new_name(insert.name);
  Copier names(document);
  const std::string name = names.fresh(insert.name.empty() ? "BODY" : insert.name);
  TextEdits edits;
  std::string model = inline_of(document, insert.url);
  if (model.empty()) {
    model = names.fresh(name + "_MODEL");
    const std::string text = fmt::format("<Inline DEF='{}' url='{}'/>", model,
                                         authoring::escape_attribute(authoring::quote_strings({insert.url})));
    authoring::append_inside(document, document.scene(),
                             with_margin(text, authoring::inner_margin_of(document, document.scene())), edits);
  }
  append_body(document, mesh_body(insert, name, model), edits);
  return Grown{edits.apply(document.source()), name};
}

Expected<Grown> with_copy(const Document& document, const DuplicateBody& duplicate) {
  const NodeId body = document.find_def(duplicate.node);
  if (!body || document[body].name != "RigidBody") return no_such_node(document, duplicate.node, "RigidBody");
  const auto collections = document.elements("RigidBodyCollection");
  if (collections.empty())
    return fail(ErrorCode::missing, "there is no RigidBodyCollection", duplicate.node, "put the body into one");
  const x3d::NodeFields fields(document, body);
  const Vec3 p_WB = duplicate.p_WB.value_or(fields.vector("position") + Vec3(kCopyBeside_m, 0, 0));
  // A body may stand within the joint that it belongs to; its copy belongs to no joint.
  const NodeId parent = document[body].parent;
  const bool beside = parent && document[parent].name == "RigidBodyCollection";
  Attributes changes{{"position", in_words(p_WB)}};
  if (!beside) changes.emplace_back("containerField", "bodies");
  Copier copier(document);
  const std::string text = copier.copy(body, changes);
  TextEdits edits;
  if (beside) {
    edits.insert(document[body].span.end, std::string(authoring::margin_of(document, body)) + text);
  } else {
    authoring::append_inside(document, collections.front(),
                             authoring::inner_margin_of(document, collections.front()) + text, edits);
  }
  return Grown{edits.apply(document.source()), copier.named().front()};
}

Expected<std::string> without_node(const Document& document, const std::string& node) {
  const NodeId id = document.find_def(node);
  if (!id) return no_such_node(document, node, "");
  std::vector<NodeId> removed{id};
  if (document[id].name == "RigidBody") {
    for (const NodeId joint : joints_of(document, id))
      removed.push_back(joint);
    for (const NodeId collidable : own_collidables(document, id))
      removed.push_back(collidable);
  }
  std::set<std::string> defs;
  std::set<NodeId> elements;
  for (const NodeId one : removed) {
    // A joint and a collidable are named in collections, too.
    for (const NodeId use : one == id && document[id].name != "RigidBody" ? std::vector{one} : uses_of(document, one))
      elements.insert(use);
    std::vector<NodeId> inside;
    gather(document, one, inside);
    for (const NodeId element : inside)
      if (const std::string def = attribute_of(document, element, "DEF"); !def.empty()) defs.insert(def);
  }
  TextEdits edits;
  for (const NodeId element : elements)
    authoring::remove_element(document, element, edits);
  remove_routes(document, defs, edits);
  std::string text = edits.apply(document.source());
  x3d::Problems problems(document.path().string());
  if (auto read = x3d::read_document(text, document.path(), problems); !read)
    return fail(ErrorCode::conflict, fmt::format("'{}' cannot be taken out: {}", node, read.error().what),
                Place(document.describe(id), document[id].line), "take out first what uses it");
  return text;
}

Expected<std::string> with_pose(const Document& document, const MoveNode& move) {
  const NodeId id = document.find_def(move.node);
  if (!id) return no_such_node(document, move.node, "");
  const std::string& type = document[id].name;
  const bool body = type == "RigidBody";
  if (!body && type != "Transform" && type != "Viewpoint")
    return fail(ErrorCode::not_supported, fmt::format("a {} has no pose of its own", type),
                Place(document.describe(id), document[id].line), "move a body, a Transform or a Viewpoint");
  TextEdits edits;
  if (auto placed = place(document, id, move.X_WB, body, edits); !placed) return tl::unexpected(placed.error());
  std::set<NodeId> shown;
  for (std::size_t i = 0; body && i < document.size(); ++i) {
    const NodeId route(i);
    if (document[route].name != "ROUTE" || attribute_of(document, route, "fromNode") != move.node) continue;
    const NodeId to = document.find_def(attribute_of(document, route, "toNode"));
    if (to && document[to].name == "Transform" && x3d::frame_around(document, to)) shown.insert(to);
  }
  for (const NodeId transform : shown)
    if (auto placed = place(document, transform, move.X_WB, false, edits); !placed)
      return tl::unexpected(placed.error());
  return edits.apply(document.source());
}

Expected<std::string> with_own_set(const Document& document, const std::string& node, const std::string& set) {
  const NodeId owner = document.find_def(node);
  if (!owner) return no_such_node(document, node, "");
  TextEdits edits;
  const std::string name = authoring::escape_attribute(set);
  for (const NodeId child : document.child_elements(owner)) {
    if (document[child].name != "MetadataSet" || document.container_field(child, "metadata") != "metadata") continue;
    const NodeId into = document.resolve(child);
    if (x3d::name_of(document, into).starts_with("mechane:")) {
      // A node has one field for metadata: a set around both.
      const std::string margin = authoring::inner_margin_of(document, owner);
      edits.insert(document[child].span.begin,
                   "<MetadataSet containerField='metadata' name='mechane'>" + margin + "  ");
      authoring::set_attribute(document, child, "containerField", "value", edits);
      edits.insert(document[child].span.end,
                   fmt::format("{0}  <MetadataSet containerField='value' name='{1}'></MetadataSet>{0}</MetadataSet>",
                               margin, name));
      return edits.apply(document.source());
    }
    authoring::append_inside(document, into,
                             fmt::format("{}<MetadataSet containerField='value' name='{}'></MetadataSet>",
                                         authoring::inner_margin_of(document, into), name),
                             edits);
    return edits.apply(document.source());
  }
  authoring::append_inside(document, owner,
                           fmt::format("{}<MetadataSet containerField='metadata' name='{}'></MetadataSet>",
                                       authoring::inner_margin_of(document, owner), name),
                           edits);
  return edits.apply(document.source());
}

}  // namespace mechane::studio
