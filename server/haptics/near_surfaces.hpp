// Surfaces that a hand may touch soon: a client that renders contacts at its device's own rate must know them before they are made.
#pragma once

#include "server/haptics/hand_model.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// Fills `near` of every present user: for the tip of a one-point device and for the fingertips of a glove, the nearest surface of each
/// body that the segment does not touch; where there is no room for all, the nearest are kept. After find_contacts(); nothing in the world
/// depends on it. Allocates nothing.
void find_near_surfaces(const state::WorldDescription& description, const HandModel& hand,
                        state::WorldState& state) noexcept;

}  // namespace mechane::haptics
