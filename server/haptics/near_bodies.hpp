// Which bodies a hand may touch.
#pragma once

#include "server/collision/object.hpp"
#include "server/state/world_state.hpp"

namespace mechane::haptics {

/// Calls visit(body, object, X_WB) for each visible body with a collision object whose bounding sphere meets a ball around `p_W`.
template <class Visit>
void for_each_body_near(const state::WorldDescription& description, const state::WorldState& state, const Vec3& p_W,
                        double radius_m, const Visit& visit) {
  for (std::size_t b = 0; b < description.bodies.size(); ++b) {
    const BodyId body(b);
    const collision::Object* object = description.bodies[b].object.get();
    if (object == nullptr || !state[body].visible) continue;
    const Pose& X_WB = state[body].X_WB;
    const double reach_m = radius_m + object->bound_O.radius;
    if ((p_W - X_WB * object->bound_O.center).squaredNorm() > reach_m * reach_m) continue;
    visit(body, *object, X_WB);
  }
}

}  // namespace mechane::haptics
