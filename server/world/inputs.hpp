// Phases 1 and 2 of the tick: the devices' samples, and where they put the hands.
#pragma once

#include <span>

#include "server/haptics/hand_model.hpp"
#include "server/state/world_state.hpp"

namespace mechane::world {

/// Counts the tick and forgets the last one's events.
void begin_tick(state::WorldState& state) noexcept;

/// Takes the newest sample of each user and ages it. A stale one freezes the hand where it was (velocity zero). A user who is gone
/// lets go. A sample farther from the last than a hand can have moved marks the user as `jumped`: the grasp is let go and forces
/// start again from zero.
void take_inputs(const state::TickInputs& inputs, state::WorldState& state) noexcept;

/// Places the segments of every present hand.
void move_hands(const haptics::HandModel& hand, state::WorldState& state) noexcept;

[[nodiscard]] inline std::span<const state::Command> commands_of(const state::TickInputs& inputs) noexcept {
  return {inputs.commands.data(), inputs.command_count};
}

}  // namespace mechane::world
