#include "server/agents/event_graph.hpp"

#include <algorithm>
#include <string>

#include "server/base/assert.hpp"
#include "server/base/clock.hpp"

namespace mechane::agents {
namespace {

/// The names of a field's slots, for quantities; a quaternion's are nobody's, which a second dot says.
std::string slot_name(const state::EventField& field, std::size_t number) {
  if (field.start.size() == 1) return field.name;
  return field.name + '.' + (field.start.size() == 3 ? std::string(1, "xyz"[number]) : "q." + std::to_string(number));
}

std::unique_ptr<EventNode> make(const EventBuild& build, const state::WorldDescription& description) {
  struct Maker {
    std::string_view type;
    MakeEventNode make;
  };
  static constexpr Maker kMakers[] = {{"TimeSensor", make_time_sensor},
                                      {"ScalarInterpolator", make_interpolator},
                                      {"PositionInterpolator", make_interpolator},
                                      {"OrientationInterpolator", make_interpolator},
                                      {"ScalarDamper", make_damper},
                                      {"PositionDamper", make_damper},
                                      {"OrientationDamper", make_damper},
                                      {"ProximitySensor", make_proximity_sensor},
                                      {"BooleanFilter", make_boolean_filter},
                                      {"BooleanToggle", make_boolean_toggle},
                                      {"BooleanTrigger", make_boolean_trigger},
                                      {"TimeTrigger", make_time_trigger},
                                      {"RigidBody", make_rigid_body},
                                      {"Transform", make_transform}};
  if (build.node.type == "CollisionSensor") return make_collision_sensor(build, description);
  const auto maker = std::ranges::find(kMakers, build.node.type, &Maker::type);
  MECHANE_ASSERT(maker != std::end(kMakers));
  return maker->make(build);
}

}  // namespace

void EventNode::begin(Instant& /*instant*/) const noexcept {}
bool EventNode::accepts(const Instant& /*instant*/, Port /*port*/, const double* /*value*/) const noexcept {
  return true;
}
void EventNode::receive(Instant& /*instant*/, Port /*port*/) const noexcept {}
void EventNode::end(Instant& /*instant*/) const noexcept {}

Port EventBuild::port(std::string_view name) const {
  const auto field = std::ranges::find(node.fields, name, &state::EventField::name);
  MECHANE_ASSERT(field != node.fields.end());
  return ports[static_cast<std::size_t>(field - node.fields.begin())];
}

void Instant::send(Port port, const double* value, std::size_t numbers) noexcept {
  if (had_event_[port.id]) return;
  had_event_.set(port.id);
  std::copy_n(value, numbers, &state.memory[port.slot]);
  sent_[sent_count_++] = port.id;
}

EventGraph::EventGraph(const state::WorldDescription& description, state::MemoryLayout& layout) {
  std::vector<std::size_t> first_field;
  for (const state::EventNode& node : description.events.nodes) {
    first_field.push_back(fields_.size());
    std::vector<Port> ports;
    for (const state::EventField& field : node.fields) {
      MECHANE_ASSERT(fields_.size() < state::kMostEventFields);
      ports.push_back({layout.slots().size(), static_cast<std::uint16_t>(fields_.size())});
      fields_.push_back({ports.back(), field.start.size(), {}});
      for (std::size_t i = 0; i < field.start.size(); ++i)
        layout.add(node.name, slot_name(field, i), field.start[i]);
    }
    nodes_.push_back(make({node, layout, ports}, description));
  }
  for (const state::EventRoute& route : description.events.routes) {
    const std::size_t to = first_field[route.to_node] + route.to_field;
    const bool sends = description.events.nodes[route.to_node].fields[route.to_field].sends;
    fields_[first_field[route.from_node] + route.from_field].targets.push_back(
        {nodes_[route.to_node].get(), fields_[to].port, sends});
  }
}

void EventGraph::run(state::WorldState& state, double dt_s) const noexcept {
  if (nodes_.empty()) return;
  Instant instant(state, static_cast<double>(state.tick - state.progress.activity_tick) * kTickSeconds, dt_s);
  for (const auto& node : nodes_)
    node->begin(instant);
  for (std::size_t i = 0; i < instant.sent_count_; ++i)
    deliver(instant, fields_[instant.sent_[i]]);
  for (const auto& node : nodes_)
    node->end(instant);
}

void EventGraph::deliver(Instant& instant, const Field& from) const noexcept {
  for (const Target& to : from.targets) {
    const double* value = &instant.state.memory[from.port.slot];
    if (instant.had_event(to.port) || !to.node->accepts(instant, to.port, value)) continue;
    if (to.sends) {
      instant.send(to.port, value, from.numbers);
    } else {
      instant.had_event_.set(to.port.id);
      std::copy_n(value, from.numbers, &instant.state.memory[to.port.slot]);
    }
    to.node->receive(instant, to.port);
  }
}

}  // namespace mechane::agents
