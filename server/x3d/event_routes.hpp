// The part of X3D's event model that runs here: which nodes, which of their fields, and the ROUTEs between them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "server/x3d/document.hpp"
#include "server/x3d/values.hpp"

namespace mechane::x3d {

/// What a field's value is. `other`: X3D has the field, but nothing here reads or sends it.
enum class EventValue : std::uint8_t { boolean, time, number, vector, rotation, other };

struct EventFieldType {
  std::string_view name;
  EventValue value = EventValue::other;
  bool receives = false;  ///< a ROUTE may end here
  bool sends = false;     ///< a ROUTE may begin here
};

struct EventNodeType {
  std::string_view name;
  std::span<const EventFieldType> fields;
};

/// All that take part in events; RigidBody and Transform are the last.
[[nodiscard]] std::span<const EventNodeType> event_types();
/// Null where nodes of that type take no part in events.
[[nodiscard]] const EventNodeType* find_event_type(std::string_view node_type);

/// A ROUTE both of whose fields take part in events. Fields are indices into their types' fields.
struct RoutedFields {
  NodeId route;
  NodeId from;
  std::size_t from_field = 0;
  NodeId to;
  std::size_t to_field = 0;
};

/// All of them, in the order written.
[[nodiscard]] std::vector<RoutedFields> event_routes(const Document& document);

/// Whether it is a RigidBody or a Transform: its fields say where it is.
[[nodiscard]] bool is_frame(const Document& document, NodeId id);

/// What is wrong with a ROUTE whose nodes exist: a field that a node does not have, that cannot send or receive, or whose type is not that
/// of the other. None also where a type of node takes no part in events.
[[nodiscard]] std::optional<BadValue> route_fault(const Document& document, NodeId route);

}  // namespace mechane::x3d
