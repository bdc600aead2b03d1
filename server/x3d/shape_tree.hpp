// Which of a file's own shapes (Box, IndexedFaceSet ...) are drawn and touched, and what they belong to: a body, a Transform that events
// move, or the scenery. The importer makes meshes of them, the compiler bodies, and the checker tells of the others.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/event_routes.hpp"

namespace mechane::x3d {

/// The name of the node that holds a file's scenery: all shapes that belong to no body.
inline constexpr const char* kScenery = "SCENE";

/// Its DEF, or "RigidBody-node-17": no two elements of a file have the same.
[[nodiscard]] std::string node_name(const Document& document, NodeId id);

/// Immutable; any thread. The document must outlive it.
class ShapeTree {
 public:
  explicit ShapeTree(const Document& document);

  /// The RigidBodies whose `geometry` has a Shape, in the order written.
  [[nodiscard]] const std::vector<NodeId>& bodies() const { return bodies_; }
  [[nodiscard]] bool has_shape(NodeId body) const;
  /// The Transform that a ROUTE lets the body move: it is the body's picture. None where the body is drawn as its `geometry` is.
  [[nodiscard]] NodeId picture_of(NodeId body) const;
  /// The CollisionCollection that says how the body rubs and bounces; none where it is in no collection.
  [[nodiscard]] NodeId collection_of(NodeId body) const;
  /// The RigidBodies of a CollisionCollection's collidables, each once, in the order written; none where it is switched off.
  [[nodiscard]] std::set<NodeId> bodies_in(NodeId collection) const;
  /// The Transforms with shapes that events move, in the order written. Each is drawn and touched as a body of its own.
  [[nodiscard]] const std::vector<NodeId>& driven() const { return driven_; }
  /// The nodes that send and receive events, and the ROUTEs between them that lead to something; in the order written.
  [[nodiscard]] const std::vector<NodeId>& event_nodes() const { return event_nodes_; }
  [[nodiscard]] const std::vector<RoutedFields>& routes() const { return routes_; }
  [[nodiscard]] bool has_scenery() const { return has_scenery_; }
  /// What lies in the Scene, a grouping node, a collidable or a RigidBody, and is drawn: grouping nodes, collidables, Shapes of a
  /// geometry that we know, and Inlines of X3D files; resolved. Transforms that a body or events move are left out.
  [[nodiscard]] std::vector<NodeId> children(NodeId id) const;
  /// All elements that shapes are made of, groups and appearances included, and those that take part in events.
  [[nodiscard]] const std::set<NodeId>& used() const { return used_; }

 private:
  void find_moved();
  void find_collections();
  void find_driven(const std::vector<RoutedFields>& routes);
  void find_events();
  void keep_what_leads_to(std::vector<NodeId> goals, const std::vector<RoutedFields>& routes);
  [[nodiscard]] std::vector<NodeId> event_goals() const;
  [[nodiscard]] bool can_be_moved(NodeId frame) const;
  [[nodiscard]] bool is_drawn(NodeId id) const;
  /// Adds what lies under `id` to used(); whether there is a shape in it.
  bool reach(NodeId id);
  void use_shape(NodeId shape);

  const Document& document_;
  std::vector<NodeId> bodies_;
  std::map<NodeId, NodeId> picture_of_;     // Transform by RigidBody
  std::map<NodeId, NodeId> body_of_;        // by the collidables in its geometry
  std::map<NodeId, NodeId> collection_of_;  // by RigidBody
  std::set<NodeId> moved_;                  // those Transforms, and driven_
  std::vector<NodeId> driven_;
  std::vector<NodeId> event_nodes_;
  std::vector<RoutedFields> routes_;
  std::set<std::string> models_;  // DEFs of Inlines whose files bodies take their shapes from
  std::set<NodeId> used_;
  bool has_scenery_ = false;
};

/// The frame that an element stands in, in W, as written; none where a group around it is scaled or is not drawn.
[[nodiscard]] std::optional<Pose> frame_around(const Document& document, NodeId id);

/// The url of an Inline that names an X3D file beside this one; empty where it has none.
[[nodiscard]] std::string inlined_x3d(const Document& document, NodeId inline_node);

}  // namespace mechane::x3d
