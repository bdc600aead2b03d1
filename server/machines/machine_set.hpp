// The machines of one world: what water, springs and steam do to the bodies, and the quantities that rules and displays read.
#pragma once

#include <memory>

#include "server/base/error.hpp"
#include "server/state/world_state.hpp"

namespace mechane::machines {

/// Made and linked once for a world, never changed after that: all that machines remember lies in WorldState::memory.
class MachineSet {
 public:
  /// Takes memory slots. Errors name the machine, its line, what is wrong and what to write: unknown type, bad parameters, a
  /// geometry that is impossible.
  [[nodiscard]] static Expected<std::unique_ptr<MachineSet>> create(const state::WorldDescription& description,
                                                                    state::MemoryLayout& layout);
  /// Lets machines find the values of agents that they read. Once, when the agents have their slots too, and before run().
  /// Errors: as create().
  [[nodiscard]] Expected<void> link(const state::MemoryLayout& layout);
  ~MachineSet();
  MachineSet(const MachineSet&) = delete;
  MachineSet& operator=(const MachineSet&) = delete;

  /// One tick, in the order of the description: reads joints, writes JointState::load and ::resistance, memory and events.
  /// Allocates nothing. Any thread, but one at a time for a state.
  void run(state::WorldState& state, double dt_s) const noexcept;

 private:
  struct Impl;
  explicit MachineSet(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mechane::machines
