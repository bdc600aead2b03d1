// The hand of a scenario's own visit: where it reaches, and round which joint it turns.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "server/state/description.hpp"
#include "tests/support/scripted_hand.hpp"

namespace mechane::test {

/// A scripted hand that reaches as the first move of the activity's visit does, then turns round the visit's joint. The joint's moving
/// body stands in its place, as it does once the activity has begun. None where the scenario has no such visit.
inline std::optional<ScriptedHand> visit_hand(const state::WorldDescription& world, const std::string& activity,
                                              double rate_rad_per_s) {
  using Kind = state::VisitMove::Kind;
  const ActivityId id = world.find_activity(activity);
  for (const auto& visit : world.visits) {
    if (visit.activity != id) continue;
    const auto is = [](Kind kind) { return [kind](const state::VisitMove& move) { return move.kind == kind; }; };
    const auto reach = std::ranges::find_if(visit.moves, is(Kind::reach));
    const auto turn = std::ranges::find_if(visit.moves, is(Kind::turn));
    if (reach == visit.moves.end() || turn == visit.moves.end()) return std::nullopt;
    const auto& joint = world.joints[turn->joint.index()];
    const Pose X_WAxis = world.bodies[joint.body1.index()].X_WB * joint.X_B1J;
    const Pose X_WBody = X_WAxis * joint.X_B2J.inverse();
    return ScriptedHand(X_WBody * reach->p_BG, X_WAxis, rate_rad_per_s);
  }
  return std::nullopt;
}

}  // namespace mechane::test
