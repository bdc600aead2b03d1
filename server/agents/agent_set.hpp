// The agents of one world and the steps that they serve: what hands do becomes grasps, placings and turns, and those move the
// visit from step to step.
#pragma once

#include <memory>
#include <span>

#include "server/base/error.hpp"
#include "server/state/input.hpp"
#include "server/state/world_state.hpp"

namespace mechane::agents {

/// Made once for a world, never changed: all that agents remember lies in WorldState::memory.
///
/// Activities. Starting one (a command, or start()) puts bodies, joints and memory back to where the description has them, lets go
/// of every grasp, sets the agents' switches and runs the activity's first step. An agent that some step enables is off until a
/// step does; all others are on. Steps add up: each changes only what it names.
///
/// Commands are answered in the same tick by an event, command_done or command_refused. A click goes to the agents of its body.
/// `next_step` goes where the step's first trigger leads; without triggers, where its time-out leads; without either it ends the
/// activity.
///
/// Quantities are read at the end of run(), so a machine's values are those of the tick before. Sources: "<AGENT or
/// MACHINE>.<value>" as their types offer them; "<JOINT>.position" (rad or m), ".angle" (rad), ".rate" (rad/s or m/s), ".turns";
/// "<BODY>.position.x" (y, z; m); "<NODE>.<field>" of X3D's nodes that send events, of a vector with .x, .y or .z. The unit "rpm" of a
/// `.rate` and "deg" of an `.angle` convert; other units are only shown.
class AgentSet {
 public:
  /// Takes memory slots. Make the machines first: quantities may read what they offer, and restarting an activity resets every
  /// slot given out so far. `description` must outlive the set. Errors name the component (with its line) or the step, what is wrong and
  /// what to write: an unknown type, bad parameters, an unknown source of a quantity (with the list of those that exist), a step or an
  /// activity that leads to a step that does not exist.
  [[nodiscard]] static Expected<std::unique_ptr<AgentSet>> create(const state::WorldDescription& description,
                                                                  state::MemoryLayout& layout);
  ~AgentSet();
  AgentSet(const AgentSet&) = delete;
  AgentSet& operator=(const AgentSet&) = delete;

  /// Puts a new state into the first activity's first step, and gives it its couplings. `state.memory` must hold layout.initial().
  /// Not in the tick; before DynamicsWorld::create.
  void start(state::WorldState& state) const noexcept;

  /// One tick: commands, X3D's own events, agents that switch others (breakable, assembled, fired), the other agents in the order of the
  /// description, `touched` events, quantities, triggers. Reads contacts, samples and poses; writes grasps, joints, body flags, surfaces,
  /// progress, quantities, events. Allocates nothing. Any thread, but one at a time for a state.
  void run(state::WorldState& state, std::span<const state::Command> commands, double dt_s) const noexcept;

 private:
  struct Impl;
  explicit AgentSet(std::unique_ptr<const Impl> impl);
  std::unique_ptr<const Impl> impl_;
};

}  // namespace mechane::agents
