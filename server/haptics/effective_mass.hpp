// How heavy a body feels at a point. This bounds the stiffness and damping that an explicit contact force may have.
#pragma once

#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// m_eff of a body along unit vector n_W at p_WQ, kg, as simulated (effort-scaled): the inverse of the speed that a unit impulse
/// gives to the point. Seen through the body's hinge or slider where one is enabled. Infinite for a body that cannot move.
[[nodiscard]] double effective_mass_kg(const state::WorldDescription& description, const state::WorldState& state,
                                       BodyId body, const Vec3& p_WQ, const Vec3& n_W) noexcept;

}  // namespace mechane::haptics
