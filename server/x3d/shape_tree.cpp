#include "server/x3d/shape_tree.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/x3d/metadata.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::x3d {
namespace {

template <std::size_t N>
bool among(const std::string_view (&words)[N], std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

constexpr std::string_view kGroups[] = {"Transform", "Group", "StaticGroup", "Collision", "Anchor", "Switch"};
constexpr std::string_view kCollidables[] = {"CollidableShape", "CollidableOffset"};
constexpr std::string_view kGeometries[] = {"Box",         "Sphere",         "Cone",
                                            "Cylinder",    "IndexedFaceSet", "IndexedTriangleSet",
                                            "TriangleSet", "Extrusion",      "ElevationGrid"};
/// What Shapes are made of, geometries apart.
constexpr std::string_view kPieces[] = {"Appearance", "Material",         "PhysicalMaterial", "ImageTexture",
                                        "Coordinate", "CoordinateDouble", "Normal",           "TextureCoordinate"};

/// Where our own reader looks for the children of each of these.
std::string_view slot_of(std::string_view type) {
  if (type == "RigidBody") return "geometry";
  if (type == "CollidableShape") return "shape";
  return type == "CollidableOffset" ? "collidable" : "children";
}

/// "position" of "position", "set_position" and "position_changed".
std::string_view plain_field(std::string_view name) {
  if (name.starts_with("set_")) name.remove_prefix(4);
  if (name.ends_with("_changed")) name.remove_suffix(8);
  return name;
}

/// Chosen by a Switch; by other groups all are.
void keep_chosen(const NodeFields& group, std::vector<NodeId>& children) {
  if (group.type() != "Switch") return;
  const double choice = group.number("whichChoice");
  const bool one = choice >= 0 && choice < static_cast<double>(children.size());
  children = one ? std::vector<NodeId>{children[static_cast<std::size_t>(choice)]} : std::vector<NodeId>{};
}

}  // namespace

std::string node_name(const Document& document, NodeId id) {
  const std::string* def = document[id].attribute("DEF");
  return def != nullptr && !def->empty() ? *def : fmt::format("{}-node-{}", document[id].name, id.index());
}

std::string inlined_x3d(const Document& document, NodeId inline_node) {
  for (const std::string& url : NodeFields(document, inline_node).strings("url")) {
    if (is_relative_path(url) && url.ends_with(".x3d")) return url;
  }
  return {};
}

ShapeTree::ShapeTree(const Document& document) : document_(document) {
  for (const NodeId id : document.elements("MetadataString")) {
    const std::string* value = name_of(document, id) == "model" ? document[id].attribute("value") : nullptr;
    const auto names = parse_strings(value != nullptr ? *value : std::string());
    if (names) models_.insert(names->begin(), names->end());
  }
  for (const NodeId body : document.elements("RigidBody")) {
    if (reach(body)) bodies_.push_back(body);
  }
  find_moved();
  find_collections();
  has_scenery_ = reach(document.scene());
}

bool ShapeTree::has_shape(NodeId body) const {
  return std::binary_search(bodies_.begin(), bodies_.end(), body);  // ids ascend in the order written
}

NodeId ShapeTree::picture_of(NodeId body) const {
  const auto found = picture_of_.find(body);
  return found == picture_of_.end() ? NodeId::none() : found->second;
}

/// By ROUTEs of a body's position or orientation. One Transform is the picture of one body, the first that moves it. It needs a
/// shape that is drawn.
void ShapeTree::find_moved() {
  for (const NodeId id : document_.elements("ROUTE")) {
    const Node& route = document_[id];
    const auto end = [&](const char* name) {
      const std::string* text = route.attribute(name);
      return text != nullptr ? *text : std::string();
    };
    const NodeId body = document_.find_def(end("fromNode"));
    const NodeId moved = document_.find_def(end("toNode"));
    if (!body || !moved || !has_shape(body) || document_[moved].name != "Transform") continue;
    const std::string from = end("fromField"), to = end("toField");
    const bool moves = plain_field(from) == "position" && plain_field(to) == "translation";
    const bool turns = plain_field(from) == "orientation" && plain_field(to) == "rotation";
    if ((!moves && !turns) || !reach(moved)) continue;
    if (moved_.contains(moved) || picture_of_.contains(body)) {
      if (picture_of(body) == moved) used_.insert(id);
      continue;
    }
    moved_.insert(moved);
    picture_of_[body] = moved;
    used_.insert(id);
  }
}

NodeId ShapeTree::collection_of(NodeId body) const {
  const auto found = collection_of_.find(body);
  return found == collection_of_.end() ? NodeId::none() : found->second;
}

void ShapeTree::find_collections() {
  std::map<NodeId, NodeId> body_of;  // by the collidables in its geometry
  for (const NodeId body : bodies_) {
    for (const NodeId collidable : children(body))
      body_of.emplace(collidable, body);
  }
  for (const NodeId id : document_.elements("CollisionCollection")) {
    if (!NodeFields(document_, id).boolean("enabled")) continue;
    for (const NodeId collidable : NodeFields(document_, id).nodes("collidables")) {
      const auto body = body_of.find(collidable);
      if (body == body_of.end()) continue;
      collection_of_.emplace(body->second, id);
      used_.insert(id);
    }
  }
}

bool ShapeTree::is_drawn(NodeId id) const {
  const Node& node = document_[id];
  if (among(kGroups, node.name)) return !moved_.contains(id) && NodeFields(document_, id).boolean("visible");
  if (node.name == "Shape") {
    const NodeFields shape(document_, id);
    const NodeId geometry = shape.node("geometry");
    return geometry && among(kGeometries, document_[geometry].name) && shape.boolean("visible");
  }
  if (node.name != "Inline") return false;
  const std::string* def = node.attribute("DEF");
  return (def == nullptr || !models_.contains(*def)) && !inlined_x3d(document_, id).empty();
}

std::vector<NodeId> ShapeTree::children(NodeId id) const {
  const NodeFields parent(document_, id);
  std::vector<NodeId> found = parent.nodes(slot_of(parent.type()));
  keep_chosen(parent, found);
  const bool of_body = parent.type() == "RigidBody" || among(kCollidables, parent.type());
  std::erase_if(found, [&](NodeId child) {
    if (of_body && among(kCollidables, document_[child].name)) return !NodeFields(document_, child).boolean("enabled");
    return !is_drawn(child);
  });
  return found;
}

bool ShapeTree::reach(NodeId top) {
  bool shapes = false;
  std::set<NodeId> seen;
  std::vector<NodeId> open{top};
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    const std::string& type = document_[id].name;
    if (type == "Shape") use_shape(id);
    if (type == "Shape" || type == "Inline") {
      shapes = true;
      used_.insert(id);
      continue;
    }
    const std::vector<NodeId> below = children(id);
    open.insert(open.end(), below.begin(), below.end());
    if (id != top || among(kGroups, type)) used_.insert(id);
  }
  return shapes;
}

void ShapeTree::use_shape(NodeId shape) {
  std::vector<NodeId> open = NodeFields(document_, shape).nodes("appearance");
  open.push_back(NodeFields(document_, shape).node("geometry"));
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    const std::string& type = document_[id].name;
    if (!among(kPieces, type) && !among(kGeometries, type)) continue;
    used_.insert(id);
    for (const NodeId child : document_.child_elements(id))
      open.push_back(document_.resolve(child));
  }
}

}  // namespace mechane::x3d
