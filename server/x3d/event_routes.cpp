#include "server/x3d/event_routes.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/x3d/schema.hpp"

namespace mechane::x3d {
namespace {

using enum EventValue;

constexpr EventFieldType in(std::string_view name, EventValue value) {
  return {name, value, true, false};
}
constexpr EventFieldType out(std::string_view name, EventValue value) {
  return {name, value, false, true};
}
constexpr EventFieldType both(std::string_view name, EventValue value) {
  return {name, value, true, true};
}

constexpr EventFieldType kTimeSensor[] = {both("cycleInterval", time),
                                          both("enabled", boolean),
                                          both("loop", boolean),
                                          both("startTime", time),
                                          both("stopTime", time),
                                          both("pauseTime", time),
                                          both("resumeTime", time),
                                          out("isActive", boolean),
                                          out("isPaused", boolean),
                                          out("elapsedTime", time),
                                          out("fraction_changed", number),
                                          out("cycleTime", time),
                                          out("time", time)};
constexpr EventFieldType kScalarInterpolator[] = {in("set_fraction", number), out("value_changed", number)};
constexpr EventFieldType kPositionInterpolator[] = {in("set_fraction", number), out("value_changed", vector)};
constexpr EventFieldType kOrientationInterpolator[] = {in("set_fraction", number), out("value_changed", rotation)};
constexpr EventFieldType kScalarDamper[] = {
    in("set_destination", number), in("set_value", number), out("value_changed", number),
    out("isActive", boolean),      both("tau", time),       both("tolerance", number)};
constexpr EventFieldType kPositionDamper[] = {
    in("set_destination", vector), in("set_value", vector), out("value_changed", vector),
    out("isActive", boolean),      both("tau", time),       both("tolerance", number)};
constexpr EventFieldType kOrientationDamper[] = {
    in("set_destination", rotation), in("set_value", rotation), out("value_changed", rotation),
    out("isActive", boolean),        both("tau", time),         both("tolerance", number)};
constexpr EventFieldType kCollisionSensor[] = {both("enabled", boolean), out("isActive", boolean),
                                               out("contacts", other), out("intersections", other)};
constexpr EventFieldType kProximitySensor[] = {both("enabled", boolean),
                                               both("center", vector),
                                               both("size", vector),
                                               out("isActive", boolean),
                                               out("enterTime", time),
                                               out("exitTime", time),
                                               out("position_changed", vector),
                                               out("orientation_changed", rotation),
                                               out("centerOfRotation_changed", other)};
constexpr EventFieldType kBooleanFilter[] = {in("set_boolean", boolean), out("inputFalse", boolean),
                                             out("inputNegate", boolean), out("inputTrue", boolean)};
constexpr EventFieldType kBooleanToggle[] = {in("set_boolean", boolean), both("toggle", boolean)};
constexpr EventFieldType kBooleanTrigger[] = {in("set_triggerTime", time), out("triggerTrue", boolean)};
constexpr EventFieldType kTimeTrigger[] = {in("set_boolean", boolean), out("triggerTime", time)};
constexpr EventFieldType kRigidBody[] = {both("position", vector), both("orientation", rotation),
                                         out("linearVelocity", vector), out("angularVelocity", vector)};
constexpr EventFieldType kTransform[] = {both("translation", vector), both("rotation", rotation),
                                         in("addChildren", other), in("removeChildren", other)};

constexpr EventNodeType kTypes[] = {{"TimeSensor", kTimeSensor},
                                    {"ScalarInterpolator", kScalarInterpolator},
                                    {"PositionInterpolator", kPositionInterpolator},
                                    {"OrientationInterpolator", kOrientationInterpolator},
                                    {"ScalarDamper", kScalarDamper},
                                    {"PositionDamper", kPositionDamper},
                                    {"OrientationDamper", kOrientationDamper},
                                    {"CollisionSensor", kCollisionSensor},
                                    {"ProximitySensor", kProximitySensor},
                                    {"BooleanFilter", kBooleanFilter},
                                    {"BooleanToggle", kBooleanToggle},
                                    {"BooleanTrigger", kBooleanTrigger},
                                    {"TimeTrigger", kTimeTrigger},
                                    {"RigidBody", kRigidBody},
                                    {"Transform", kTransform}};

/// X3D also calls a field that receives and sends "set_x" and "x_changed".
const EventFieldType* find_field(const EventNodeType& type, std::string_view name, bool sends) {
  const auto found = std::ranges::find_if(type.fields, [&](const EventFieldType& field) {
    if (field.name == name) return true;
    const std::string alias = sends ? std::string(field.name) + "_changed" : "set_" + std::string(field.name);
    return field.receives == field.sends && alias == name;
  });
  return found == type.fields.end() ? nullptr : &*found;
}

/// Of X3D's fields that receive and send, whether or not they take part here.
bool in_schema(std::string_view node_type, std::string_view name) {
  const NodeType* type = Schema::standard().find(node_type);
  if (name.starts_with("set_")) name.remove_prefix(4);
  if (name.ends_with("_changed")) name.remove_suffix(8);
  return type == nullptr || type->field(name) != nullptr || type->slot(name) != nullptr;
}

/// One end of a ROUTE.
struct End {
  const char* attribute;  ///< "fromField"
  NodeId node;
  const EventNodeType* type = nullptr;    ///< null: it takes no part in events
  const EventFieldType* field = nullptr;  ///< null: the same
  std::string_view name{};
  bool sends = false;

  [[nodiscard]] bool takes_part() const { return field != nullptr && field->value != other && fits(); }
  [[nodiscard]] bool fits() const { return sends ? field->sends : field->receives; }
};

End end_of(const Document& document, NodeId route, bool sends) {
  const auto text = [&](const char* name) {
    const std::string* value = document[route].attribute(name);
    return value != nullptr ? std::string_view(*value) : std::string_view();
  };
  End end{.attribute = sends ? "fromField" : "toField",
          .node = document.find_def(text(sends ? "fromNode" : "toNode")),
          .name = text(sends ? "fromField" : "toField"),
          .sends = sends};
  if (end.node) end.type = find_event_type(document[end.node].name);
  if (end.type != nullptr) end.field = find_field(*end.type, end.name, sends);
  return end;
}

std::optional<BadValue> end_fault(const Document& document, const End& end) {
  if (end.type == nullptr || in_schema(end.type->name, end.name)) return std::nullopt;
  if (end.field != nullptr && end.fits()) return std::nullopt;
  std::vector<std::string> known;
  for (const EventFieldType& field : end.type->fields) {
    if (end.sends ? field.sends : field.receives) known.emplace_back(field.name);
  }
  const std::string what = end.field == nullptr ? "has no field" : end.sends ? "does not send" : "does not receive";
  return BadValue{
      fmt::format("{}: {} {} '{}'", end.attribute, document.describe(end.node), what, end.name.substr(0, 80)),
      suggest(std::string(end.name), known, "remove the ROUTE")};
}

std::string_view x3d_name(EventValue value) {
  static constexpr std::string_view kNames[] = {"SFBool", "SFTime", "SFFloat", "SFVec3f", "SFRotation", ""};
  return kNames[static_cast<std::size_t>(value)];
}

}  // namespace

std::span<const EventNodeType> event_types() {
  return kTypes;
}

const EventNodeType* find_event_type(std::string_view node_type) {
  const auto found = std::ranges::find(kTypes, node_type, &EventNodeType::name);
  return found == std::end(kTypes) ? nullptr : &*found;
}

std::vector<RoutedFields> event_routes(const Document& document) {
  std::vector<RoutedFields> routes;
  for (const NodeId id : document.elements("ROUTE")) {
    const End from = end_of(document, id, true), to = end_of(document, id, false);
    if (!from.takes_part() || !to.takes_part() || from.field->value != to.field->value) continue;
    routes.push_back({id, from.node, static_cast<std::size_t>(from.field - from.type->fields.data()), to.node,
                      static_cast<std::size_t>(to.field - to.type->fields.data())});
  }
  return routes;
}

bool is_frame(const Document& document, NodeId id) {
  return document[id].name == "RigidBody" || document[id].name == "Transform";
}

std::optional<BadValue> route_fault(const Document& document, NodeId route) {
  const End from = end_of(document, route, true), to = end_of(document, route, false);
  if (auto fault = end_fault(document, from)) return fault;
  if (auto fault = end_fault(document, to)) return fault;
  if (!from.takes_part() || !to.takes_part() || from.field->value == to.field->value) return std::nullopt;
  return BadValue{fmt::format("'{}' is an {}, and '{}' an {}", from.name, x3d_name(from.field->value), to.name,
                              x3d_name(to.field->value)),
                  "route to a field of the same type, or put a node between the two that has both types"};
}

}  // namespace mechane::x3d
