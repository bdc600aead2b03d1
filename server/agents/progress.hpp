// Where the visit is: activities, their steps, and the triggers that lead from one to the next.
#pragma once

#include <vector>

#include "server/base/error.hpp"
#include "server/state/input.hpp"
#include "server/state/world_state.hpp"

namespace mechane::agents {

/// The rules of a scenario. Immutable; where the visit is lies in WorldState::progress and, for the time that a trigger has held, in
/// memory.
class ProgressRules {
 public:
  /// Takes one slot for each trigger. Errors: an id that is not in its table, a number that is not finite or negative. The description
  /// must outlive this.
  [[nodiscard]] static Expected<ProgressRules> create(const state::WorldDescription& description,
                                                      state::MemoryLayout& layout);
  /// Keeps the slots' initial values, which a restart puts back. Call it when every slot has been given out.
  void remember_start(const state::MemoryLayout& layout) { memory_ = layout.initial(); }

  void start(state::WorldState& state) const noexcept;
  /// False when it cannot be done now, or is not about activities and steps.
  [[nodiscard]] bool run_command(state::WorldState& state, const state::Command& command) const noexcept;
  /// Tests the step's triggers on the quantities; the first that has held long enough fires. Leaves the step when its time is up.
  /// Notes when it is time for a hint.
  void run_triggers(state::WorldState& state, double dt_s) const noexcept;

 private:
  void start_activity(state::WorldState& state, ActivityId activity) const noexcept;
  void put_back(state::WorldState& state) const noexcept;
  void enter_step(state::WorldState& state, StepId step) const noexcept;
  void leave_step(state::WorldState& state, StepId next) const noexcept;

  const state::WorldDescription* description_ = nullptr;
  std::vector<state::BodyState> bodies_;  // at the start
  std::vector<state::JointState> joints_;
  std::vector<std::uint8_t> agent_enabled_;
  std::vector<double> memory_;
  std::vector<std::size_t> first_hold_;  // slot of each step's first trigger; the others follow
};

}  // namespace mechane::agents
