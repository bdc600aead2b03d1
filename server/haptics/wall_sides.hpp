// Walls hold: what is pressed through a thin wall, a fingertip or a palm, is still pushed back to the side that it came from.
#pragma once

#include "server/haptics/contact_patch.hpp"
#include "server/haptics/hand_model.hpp"

namespace mechane::haptics {

/// What thin walls hold. `let_through`: nothing, and they are not smoothed, as in journals before StateVersion::with_sides. `hold_tips`:
/// each by one wall, as in those before StateVersion::with_corners.
enum class ThinWalls { let_through, hold_tips, hold_hands };

/// Puts right the touches of tips (of a one-point device, of fingers) and palms that are pressed in so deep that their contacts no longer
/// tell the way out: once a segment's middle has passed a thin wall, they point to the other side, or there are none. Such a segment is
/// moved back to where it lies in the surface that it came through, and touches there; its depth is how far it was moved, and how deep it
/// then lies. As it goes along behind the wall, its place before it follows the surface, and where the wall ends, it is free. In a corner
/// it is moved out of both walls. This is the god-object of Zilles and Salisbury (1995), with a size of its own (Ruspini et al. 1997), over
/// distance maps. For a hand that begins inside a body, contacts count until it has been out of them.
///
/// `patches`: the touches. Moves `user.sides`. Lives in the tick; allocates nothing.
void hold_walls(const state::WorldDescription& description, const HandModel& hand, const state::WorldState& state,
                state::UserState& user, ThinWalls walls, ContactPatches& patches) noexcept;

/// Distance of the side's segment behind its wall, m; negative before it.
[[nodiscard]] double depth_behind_m(const HandModel& hand, const state::WorldState& state, const state::UserState& user,
                                    const state::WallSide& side, ThinWalls walls = ThinWalls::hold_hands) noexcept;

/// Whether that segment has a side of that body.
[[nodiscard]] bool has_side(const state::UserState& user, std::size_t segment, BodyId body) noexcept;

}  // namespace mechane::haptics
