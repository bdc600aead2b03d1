// X3D's own sensors, interpolators and dampers, and the ROUTEs between them and bodies, in the world's time.
#pragma once

#include <memory>
#include <vector>

#include "server/agents/event_node.hpp"

namespace mechane::agents {

/// Made once for a world, never changed: what nodes remember lies in WorldState::memory, and a world without such nodes has none.
///
/// The world's time counts from the beginning of its activity. In each tick all nodes look at time, bodies and hands, in the file's order;
/// then each event is brought to where ROUTEs lead, in the order in which they were sent, and of one field in the file's order; last,
/// bodies go where events put them. Of two events for one field in one tick, the first counts.
class EventGraph {
 public:
  EventGraph() = default;
  /// Takes memory slots, "<DEF>.<field>" and for a vector "<DEF>.<field>.x", y and z. `description` must outlive the graph.
  EventGraph(const state::WorldDescription& description, state::MemoryLayout& layout);

  /// One tick. Allocates nothing.
  void run(state::WorldState& state, double dt_s) const noexcept;

 private:
  struct Target {
    const EventNode* node;
    Port port;
    bool sends;
  };
  struct Field {
    Port port;
    std::size_t numbers = 0;      // of its value
    std::vector<Target> targets;  // of the ROUTEs that begin here, in the file's order
  };

  void deliver(Instant& instant, const Field& from) const noexcept;

  std::vector<std::unique_ptr<EventNode>> nodes_;
  std::vector<Field> fields_;  // by Port::id
};

}  // namespace mechane::agents
