// The world's quantities: numbers by name that rules test and displays show.
#pragma once

#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/world_state.hpp"

namespace mechane::agents {

/// Where each quantity comes from, resolved once.
class Quantities {
 public:
  /// Error: an unknown source, with the sources that exist.
  [[nodiscard]] static Expected<Quantities> create(const state::WorldDescription& description,
                                                   const state::MemoryLayout& layout);

  /// Overwrites WorldState::quantities. Allocates nothing.
  void update(state::WorldState& state) const noexcept;

 private:
  enum class From { memory, joint_position, joint_velocity, body_position, body_speed };
  struct Source {
    From from = From::memory;
    std::size_t index = 0;
    int axis = 0;
    double factor = 1;
  };
  [[nodiscard]] static Expected<Source> resolve(const state::WorldDescription& description,
                                                const state::MemoryLayout& layout,
                                                const state::QuantityDescription& quantity);
  std::vector<Source> sources_;
};

}  // namespace mechane::agents
