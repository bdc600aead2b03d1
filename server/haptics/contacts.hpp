// Phase 3 of the tick: where hands and bodies overlap.
#pragma once

#include "server/haptics/hand_model.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// Fills contacts of every present user from the bodies that have a collision object. Of too many, the deepest are kept, and the deepest
/// few of every touch (one segment on one body). Contacts with a held body are among them: they tell whether the fingers still close on
/// it, though its force comes from the grasp spring alone. Allocates nothing.
void find_contacts(const state::WorldDescription& description, const HandModel& hand,
                   state::WorldState& state) noexcept;

}  // namespace mechane::haptics
