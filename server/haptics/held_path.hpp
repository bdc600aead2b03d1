// The path on which a user's held body can move, as a client needs it.
#pragma once

#include "server/hand/hand_force.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// The path of the grip of `user`, with the last tick's reaction along it. None where the hand holds nothing, or the body is not tied by
/// one hinge (that is not a screw) or slider alone, to the world or a fixed body, or is held within 2 cm of its hinge's axis. Allocates
/// nothing.
[[nodiscard]] hand::HeldPath held_path(const state::WorldDescription& description, const state::WorldState& state,
                                       const state::UserState& user) noexcept;

}  // namespace mechane::haptics
