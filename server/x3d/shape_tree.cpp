#include "server/x3d/shape_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

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

std::optional<Pose> frame_around(const Document& document, NodeId id) {
  Pose X_WP;
  for (NodeId group = document[id].parent; group && group != document.scene(); group = document[group].parent) {
    if (!among(kGroups, document[group].name) || document[group].name == "Switch") return std::nullopt;
    const NodeFields fields(document, group);
    if (!fields.boolean("visible")) return std::nullopt;
    if (fields.type() != "Transform") continue;
    if (!fields.vector("scale").isOnes()) return std::nullopt;
    const Quat R = fields.rotation("rotation");
    const Vec3 center = fields.vector("center");
    X_WP = Pose{fields.vector("translation") + center - R * center, R} * X_WP;
  }
  return X_WP;
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
  find_events();
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
  for (const NodeId body : bodies_) {
    for (const NodeId collidable : children(body))
      body_of_.emplace(collidable, body);
  }
  for (const NodeId id : document_.elements("CollisionCollection")) {
    for (const NodeId body : bodies_in(id)) {
      collection_of_.emplace(body, id);
      used_.insert(id);
    }
  }
}

std::set<NodeId> ShapeTree::bodies_in(NodeId collection) const {
  std::set<NodeId> bodies;
  const NodeFields fields(document_, collection);
  if (!fields.boolean("enabled")) return bodies;
  for (const NodeId collidable : fields.nodes("collidables")) {
    const auto body = body_of_.find(collidable);
    if (body != body_of_.end()) bodies.insert(body->second);
  }
  return bodies;
}

void ShapeTree::find_driven(const std::vector<RoutedFields>& routes) {
  std::set<NodeId> targets = moved_;
  for (const RoutedFields& route : routes)
    targets.insert(route.to);
  for (const NodeId id : targets) {
    if (document_[id].name != "Transform" || moved_.contains(id) || !frame_around(document_, id)) continue;
    NodeId around = document_[id].parent;
    while (around && !targets.contains(around))
      around = document_[around].parent;
    if (!around && reach(id)) driven_.push_back(id);
  }
  moved_.insert(driven_.begin(), driven_.end());
}

/// Events can move what would stand still without them.
bool ShapeTree::can_be_moved(NodeId frame) const {
  if (document_[frame].name == "Transform") return std::binary_search(driven_.begin(), driven_.end(), frame);
  return NodeFields(document_, frame).boolean("fixed");
}

/// What events are for: to move things, and to be read. A node from which no ROUTE leads can only be meant to be read; so can every one in
/// a file whose quantities may name it.
std::vector<NodeId> ShapeTree::event_goals() const {
  const auto sets = document_.elements("MetadataSet");
  const bool read =
      std::ranges::any_of(sets, [&](NodeId set) { return name_of(document_, set) == "mechane:scenario"; });
  std::set<NodeId> senders;
  for (const NodeId route : document_.elements("ROUTE")) {
    const std::string* from = document_[route].attribute("fromNode");
    if (from != nullptr) senders.insert(document_.find_def(*from));
  }
  std::vector<NodeId> goals = driven_;
  for (const EventNodeType& type : event_types()) {
    for (const NodeId id : document_.elements(type.name)) {
      if (is_frame(document_, id) ? type.name == "RigidBody" && can_be_moved(id) : read || !senders.contains(id))
        goals.push_back(id);
    }
  }
  return goals;
}

void ShapeTree::find_events() {
  std::vector<RoutedFields> all = event_routes(document_);
  std::erase_if(all,
                [&](const RoutedFields& route) { return used_.contains(route.route); });  // a body's to its picture
  find_driven(all);
  keep_what_leads_to(event_goals(), all);
  std::ranges::copy_if(event_nodes_, std::inserter(used_, used_.end()),
                       [&](NodeId id) { return !is_frame(document_, id); });
  for (const RoutedFields& route : routes_)
    used_.insert(route.route);
}

void ShapeTree::keep_what_leads_to(std::vector<NodeId> goals, const std::vector<RoutedFields>& routes) {
  std::multimap<NodeId, const RoutedFields*> into;
  for (const RoutedFields& route : routes) {
    const bool still = document_[route.from].name == "Transform" && !can_be_moved(route.from);
    if (!still && (!is_frame(document_, route.to) || can_be_moved(route.to))) into.emplace(route.to, &route);
  }
  std::set<NodeId> kept(goals.begin(), goals.end()), routes_kept;
  while (!goals.empty()) {
    const auto [first, last] = into.equal_range(goals.back());
    goals.pop_back();
    for (auto it = first; it != last; ++it) {
      routes_kept.insert(it->second->route);
      if (kept.insert(it->second->from).second) goals.push_back(it->second->from);
    }
  }
  std::ranges::copy_if(routes, std::back_inserter(routes_),
                       [&](const RoutedFields& route) { return routes_kept.contains(route.route); });
  std::set<NodeId> routed;
  for (const RoutedFields& route : routes_)
    routed.insert({route.from, route.to});
  std::ranges::copy_if(kept, std::back_inserter(event_nodes_),
                       [&](NodeId id) { return !is_frame(document_, id) || routed.contains(id); });
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
