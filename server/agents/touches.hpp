// `touched` events: when a hand comes to a body.
#pragma once

#include <vector>

#include "server/state/world_state.hpp"

namespace mechane::agents {

/// Emits `touched` when a user's hand touches a body that it has not touched for a quarter of a second.
class Touches {
 public:
  Touches() = default;
  /// Takes a slot for each user and touchable body.
  Touches(const state::WorldDescription& description, state::MemoryLayout& layout);

  void run(state::WorldState& state, double dt_s) const noexcept;

 private:
  struct Watch {
    std::size_t user;
    BodyId body;
    std::size_t since_s;  // slot: time since the last contact
  };
  std::vector<Watch> watches_;
};

}  // namespace mechane::agents
