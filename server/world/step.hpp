// One tick of a world.
#pragma once

#include "server/state/input.hpp"
#include "server/world/phase.hpp"
#include "server/world/world.hpp"

namespace mechane::world {

/// Where a tick's result goes: the network and the records. Called at the end of every tick, by the loop's thread; must be
/// wait-free.
class Publisher {
 public:
  virtual ~Publisher() = default;
  virtual void publish(const state::WorldState& state) noexcept = 0;
};

/// Advances the world by one millisecond. Same state and inputs give the same bits. Allocates nothing, locks nothing, logs nothing,
/// throws nothing.
void step(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept;

}  // namespace mechane::world
