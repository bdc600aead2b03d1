// One tick of a world.
#pragma once

#include "server/state/input.hpp"
#include "server/world/phase.hpp"
#include "server/world/world.hpp"

namespace mechane::world {

/// Where a tick's result goes: the network and the records. Called in every tick, by the loop's thread; must be wait-free.
class Publisher {
 public:
  virtual ~Publisher() = default;
  /// Called as soon as every user's output is final, so that a device need not wait for the bodies to move.
  virtual void publish_forces(const state::WorldState& state) noexcept = 0;
  /// At the end of the tick.
  virtual void publish(const state::WorldState& state) noexcept = 0;
};

/// For worlds that nobody watches: a replay, a benchmark.
class NoPublisher final : public Publisher {
 public:
  void publish_forces(const state::WorldState&) noexcept override {}
  void publish(const state::WorldState&) noexcept override {}
};

/// Advances the world by one millisecond. Same state and inputs give the same bits. Allocates nothing, locks nothing, logs nothing,
/// throws nothing.
void step(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept;

}  // namespace mechane::world
