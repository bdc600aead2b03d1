// What a node of X3D is to the graph of events that runs it. Inside this room only.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <memory>
#include <string_view>

#include "server/state/world_state.hpp"

namespace mechane::agents {

/// A field of a node: where its value lies in WorldState::memory, and its number among all fields of the graph.
struct Port {
  std::size_t slot = 0;
  std::uint16_t id = 0;
};

/// One moment of the world's time. X3D: a field gets at most one event in it, so cascades end, whatever circles ROUTEs make. Lives on the
/// stack of a tick.
class Instant {
 public:
  Instant(state::WorldState& state_in, double now, double dt) : state(state_in), now_s(now), dt_s(dt) {}

  state::WorldState& state;
  const double now_s;  ///< since the activity began
  const double dt_s;

  [[nodiscard]] double number(Port port) const noexcept { return state.memory[port.slot]; }
  [[nodiscard]] bool flag(Port port) const noexcept { return state.memory[port.slot] != 0; }
  [[nodiscard]] Vec3 vector(Port port) const noexcept { return Vec3(&state.memory[port.slot]); }
  [[nodiscard]] Quat rotation(Port port) const noexcept { return Quat(&state.memory[port.slot]); }
  [[nodiscard]] bool had_event(Port port) const noexcept { return had_event_[port.id]; }

  /// Gives a field its value, and all that ROUTEs lead to. Nothing where the field has had its event.
  void send(Port port, double value) noexcept { send(port, &value, 1); }
  void send(Port port, const Vec3& value) noexcept { send(port, value.data(), 3); }
  void send(Port port, const Quat& value) noexcept { send(port, value.coeffs().data(), 4); }
  void send(Port port, const double* value, std::size_t numbers) noexcept;

 private:
  friend class EventGraph;
  std::bitset<state::kMostEventFields> had_event_;
  std::array<std::uint16_t, state::kMostEventFields> sent_;  // ids, in the order in which they were sent
  std::size_t sent_count_ = 0;
};

/// One node. Immutable: what it remembers lies in WorldState::memory. All functions belong to the tick and allocate nothing.
class EventNode {
 public:
  virtual ~EventNode() = default;

  /// At the beginning of an instant, before any event: what comes of time, and of what bodies and hands did.
  virtual void begin(Instant& instant) const noexcept;
  /// Whether an event would be obeyed; `value` is what it brings.
  [[nodiscard]] virtual bool accepts(const Instant& instant, Port port, const double* value) const noexcept;
  /// An event came: the field has its value.
  virtual void receive(Instant& instant, Port port) const noexcept;
  /// When all events of the instant have been delivered.
  virtual void end(Instant& instant) const noexcept;
};

/// What a maker gets.
struct EventBuild {
  const state::EventNode& node;
  state::MemoryLayout& layout;
  std::span<const Port> ports;  ///< of the node's fields

  /// The field of that name, which the node must have.
  [[nodiscard]] Port port(std::string_view name) const;
  /// A slot that only the node reads.
  [[nodiscard]] std::size_t slot(const std::string& name, double start = 0) const {
    return layout.add(node.name, "own." + name, start);
  }
};

using MakeEventNode = std::unique_ptr<EventNode> (*)(const EventBuild& build);

[[nodiscard]] std::unique_ptr<EventNode> make_time_sensor(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_boolean_filter(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_boolean_toggle(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_boolean_trigger(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_time_trigger(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_interpolator(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_damper(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_collision_sensor(const EventBuild& build,
                                                               const state::WorldDescription& description);
[[nodiscard]] std::unique_ptr<EventNode> make_proximity_sensor(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_rigid_body(const EventBuild& build);
[[nodiscard]] std::unique_ptr<EventNode> make_transform(const EventBuild& build);

}  // namespace mechane::agents
