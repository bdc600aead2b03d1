// X3D's nodes that send events, the ROUTEs between them, and the bodies that events move.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/x3d/node_fields.hpp"

namespace mechane::scenario {
namespace {

using x3d::EventValue;

/// The numbers of a rotation as a quaternion.
void append(const Quat& R, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), R.coeffs().data(), R.coeffs().data() + 4);
}

/// Written in the file, or X3D's default; of a field that X3D does not let a file write: nothing, 0.
std::vector<double> start_of(const x3d::NodeFields& fields, const std::string& name, EventValue value) {
  const bool written = x3d::Schema::standard().find(fields.type())->field(name) != nullptr;
  std::vector<double> numbers;
  switch (value) {
    case EventValue::rotation:
      append(written ? fields.rotation(name) : Quat::Identity(), numbers);
      break;
    case EventValue::vector:
      numbers = written ? fields.numbers(name) : std::vector<double>(3, 0.0);
      break;
    case EventValue::boolean:
      numbers = {written && fields.boolean(name) ? 1.0 : 0.0};
      break;
    case EventValue::time:
    case EventValue::number:
      numbers = {written ? fields.number(name) : 0.0};
      break;
    case EventValue::other:
      break;
  }
  return numbers;
}

class EventCompiler {
 public:
  explicit EventCompiler(Compilation& c) : c_(c) {}

  void run() {
    drive_bodies();
    for (const x3d::NodeId id : c_.shapes.event_nodes())
      add(id);
    check_size();
    for (const x3d::RoutedFields& route : c_.shapes.routes())
      events().routes.push_back({index_of_[route.from], route.from_field, index_of_[route.to], route.to_field});
  }

 private:
  state::EventDescription& events() { return c_.world.events; }

  void error(x3d::NodeId id, ErrorCode code, std::string what, std::string remedy) {
    c_.problems.error(code, c_.document[id].line, c_.document.describe(id), std::move(what), std::move(remedy));
  }

  /// Transforms become bodies; bodies that stand still can be moved by nothing but events. They were checked as fixed bodies.
  void drive_bodies() {
    for (const x3d::NodeId id : c_.shapes.driven()) {
      const x3d::NodeFields fields(c_.document, id);
      state::BodyDescription& body = add_own_body(c_, x3d::node_name(c_.document, id), id);
      body.X_WB = *x3d::frame_around(c_.document, id) * Pose{fields.vector("translation"), fields.rotation("rotation")};
      drive(body);
    }
    for (const x3d::RoutedFields& route : c_.shapes.routes()) {
      if (c_.document[route.to].name != "RigidBody") continue;
      if (const BodyId body = body_of(route.to)) drive(c_.world.bodies[body.index()]);
    }
  }

  static void drive(state::BodyDescription& body) {
    body.fixed = false;
    body.driven = true;
    body.use_gravity = false;
    body.mass_kg = body.mass_kg > 0 ? body.mass_kg : 1;
    body.inertia_kg_m2 = Mat3::Identity();
  }

  [[nodiscard]] BodyId body_of(x3d::NodeId frame) const {
    return c_.world.find_body(x3d::node_name(c_.document, frame));
  }

  void add(x3d::NodeId id) {
    const x3d::NodeFields fields(c_.document, id);
    state::EventNode node;
    node.name = x3d::node_name(c_.document, id);
    node.type = fields.type();
    for (const x3d::EventFieldType& field : x3d::find_event_type(node.type)->fields) {
      const std::string name(field.name);
      node.fields.push_back({name, field.sends, start_of(fields, name, field.value)});
    }
    if (c_.world.find_agent(node.name) || c_.world.find_machine(node.name))
      error(id, ErrorCode::duplicate, fmt::format("an agent or a machine is called '{}', too", node.name),
            "rename one of them");
    read_special(id, fields, node);
    index_of_[id] = events().nodes.size();
    events().nodes.push_back(std::move(node));
  }

  void read_special(x3d::NodeId id, const x3d::NodeFields& fields, state::EventNode& node) {
    if (node.type.ends_with("Interpolator")) {
      read_keys(id, fields, node);
    } else if (node.type.ends_with("Damper")) {
      node.order = static_cast<int>(fields.number("order"));
      const EventValue value = x3d::find_event_type(node.type)->fields.front().value;
      for (state::EventField& field : node.fields) {
        if (field.name == "value_changed") field.start = start_of(fields, "initialValue", value);
        if (field.name == "set_destination") field.start = start_of(fields, "initialDestination", value);
      }
    } else if (node.type == "TimeSensor") {
      if (fields.number("cycleInterval") <= 0)
        error(id, ErrorCode::invalid_value, "cycleInterval is 0 s", "write the seconds of a cycle, more than 0");
    } else if (node.type == "CollisionSensor") {
      read_pairs(id, fields, node);
    } else if (node.type == "ProximitySensor") {
      read_frame(id, node);
    } else if (x3d::is_frame(c_.document, id)) {
      node.body = body_of(id);
      if (node.type != "Transform") return;
      read_frame(id, node);
      node.center = fields.vector("center");
      node.first_rotation = fields.rotation("rotation");
    }
  }

  void read_frame(x3d::NodeId id, state::EventNode& node) {
    const auto frame = x3d::frame_around(c_.document, id);
    if (frame) {
      node.X_WP = *frame;
    } else {
      error(id, ErrorCode::not_supported, "a group around it is scaled, or not drawn",
            "put it under the Scene, or under Transforms without a scale");
    }
  }

  void read_keys(x3d::NodeId id, const x3d::NodeFields& fields, state::EventNode& node) {
    node.keys = fields.numbers("key");
    const std::vector<double> values = fields.numbers("keyValue");
    const std::size_t numbers = node.type == "ScalarInterpolator" ? 1 : node.type == "PositionInterpolator" ? 3 : 4;
    if (node.type == "OrientationInterpolator") {
      for (std::size_t i = 0; i + 3 < values.size(); i += 4)
        append(x3d::rotation_of(std::span(values).subspan(i, 4)), node.key_values);
    } else {
      node.key_values = values;
    }
    if (node.key_values.size() != node.keys.size() * numbers) {
      error(id, ErrorCode::conflict,
            fmt::format("there are {} keys, and {} values", node.keys.size(), values.size() / numbers),
            "write as many values in keyValue as numbers in key");
    } else if (const auto falls = std::ranges::is_sorted_until(node.keys); falls != node.keys.end()) {
      error(id, ErrorCode::invalid_value, fmt::format("the key {} is less than the one before it", *falls),
            "write the keys in ascending order");
    }
  }

  /// All pairs of the collider's bodies that can meet: two that stand still do not.
  void read_pairs(x3d::NodeId id, const x3d::NodeFields& fields, state::EventNode& node) {
    std::vector<BodyId> bodies;
    const x3d::NodeId collider = fields.node("collider");
    if (!collider) return;
    for (const x3d::NodeId body : c_.shapes.bodies_in(collider)) {
      for (const BodyId found : bodies_of(c_, body))
        if (c_.world.bodies[found.index()].object) bodies.push_back(found);
    }
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies.size() && pairs_ <= state::kMostSensedPairs; ++j) {
        if (c_.world.bodies[bodies[i].index()].fixed && c_.world.bodies[bodies[j].index()].fixed) continue;
        node.pairs.emplace_back(bodies[i], bodies[j]);
        ++pairs_;
      }
    }
    if (pairs_ > state::kMostSensedPairs)
      error(id, ErrorCode::too_large,
            fmt::format("CollisionSensors would watch more than {} pairs of bodies", state::kMostSensedPairs),
            "let their colliders hold fewer collidables");
  }

  void check_size() {
    if (events().nodes.size() > state::kMostEventNodes || c_.shapes.routes().size() > state::kMostEventRoutes)
      error(c_.document.scene(), ErrorCode::too_large,
            fmt::format("more than {} nodes, or {} ROUTEs, send and receive events", state::kMostEventNodes,
                        state::kMostEventRoutes),
            "leave some out");
  }

  Compilation& c_;
  std::map<x3d::NodeId, std::size_t> index_of_;
  std::size_t pairs_ = 0;
};

}  // namespace

void compile_events(Compilation& c) {
  EventCompiler(c).run();
}

}  // namespace mechane::scenario
