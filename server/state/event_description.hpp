// X3D's nodes that send events, and the ROUTEs between them, as the compiler found them in a file.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "server/base/ids.hpp"
#include "server/base/math.hpp"

namespace mechane::state {

// What a world takes: a tick goes through all of them.
inline constexpr std::size_t kMostEventNodes = 1000;
inline constexpr std::size_t kMostEventFields = 16'000;  ///< of all nodes together, of which each has up to 13
inline constexpr std::size_t kMostEventRoutes = 16'000;
inline constexpr std::size_t kMostSensedPairs = 500;  ///< of bodies, of all CollisionSensors together

/// One field that has a value: 1 number (a boolean: 0 or 1), 3 of a vector, 4 of a rotation (a quaternion's x, y, z, w).
struct EventField {
  std::string name;           ///< "fraction_changed"
  bool sends = false;         ///< can be where a ROUTE begins
  std::vector<double> start;  ///< one number for each of its value
};

struct EventNode {
  std::string name;  ///< its DEF
  std::string type;  ///< X3D's name: "TimeSensor"
  std::vector<EventField> fields;
  std::vector<double> keys;                      ///< of an interpolator, never falling
  std::vector<double> key_values;                ///< as many times a value's numbers
  int order = 0;                                 ///< of a damper
  std::vector<std::pair<BodyId, BodyId>> pairs;  ///< of a CollisionSensor: what may meet
  BodyId body;                                   ///< of a RigidBody; of a Transform: the body that stands for it
  Pose X_WP;                                     ///< frame around a Transform or a ProximitySensor; it never moves
  Vec3 center = Vec3::Zero();                    ///< of a Transform, in its own frame without its first rotation
  Quat first_rotation = Quat::Identity();        ///< of a Transform, as written
};

/// By index into the nodes, and into a node's fields. Both fields have values of one kind.
struct EventRoute {
  std::size_t from_node = 0;
  std::size_t from_field = 0;
  std::size_t to_node = 0;
  std::size_t to_field = 0;
};

struct EventDescription {
  std::vector<EventNode> nodes;    ///< in the file's order
  std::vector<EventRoute> routes;  ///< likewise
};

}  // namespace mechane::state
