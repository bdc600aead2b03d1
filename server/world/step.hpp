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

// A tick has two halves, so that a loop with several worlds can send the forces of all before it moves the bodies of any. Neither
// allocates, locks, logs or throws.

/// The first half: from what hands did to the forces that they feel; calls publish_forces().
void feel(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept;
/// The second, after feel() in the same tick: the bodies move; calls publish().
void move(World& world, Publisher& publisher, PhaseTimer& timer) noexcept;

/// Both: advances the world by one millisecond. Same state and inputs give the same bits.
void step(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept;

}  // namespace mechane::world
