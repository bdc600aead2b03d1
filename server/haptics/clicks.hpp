// Short shakes that a hand feels in what it holds or touches: a ratchet's tooth, a knock on stone.
#pragma once

#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// Gives the clicks of the scenario's `touch.click` effects to every hand that holds or touches the effect's body: one each time the
/// quantity has gone up or down by another `full`. Called in the tick, after the quantities are known; allocates nothing.
void find_clicks(const state::WorldDescription& description, state::WorldState& state) noexcept;

/// One click for a hand, N at its strongest. Left out where nobody would feel it: below 0.05 N, and within 20 ms of one as strong.
void add_click(state::UserState& user, std::uint64_t tick, double strength_n) noexcept;

}  // namespace mechane::haptics
