// What hands can do with a world's bodies: take them, turn or slide them, bring them to a place. Told to clients whose pointer is a
// hand on a flat picture: without it they could not know which way out of the picture a drag is meant.
#pragma once

#include <cstdint>
#include <vector>

#include "server/state/description.hpp"

namespace mechane::state {

/// A is the base's frame, or W; B the object's. As client::Affordance; the numbers of the kinds are those on the wire.
struct Affordance {
  enum class Kind : std::uint8_t { taken, turns, slides, placed, brought };
  Kind kind = Kind::taken;
  AgentId agent;  ///< holds while this agent is enabled; none: always
  BodyId object;
  BodyId base;  ///< none: W
  Pose X_AJ;
  Pose X_BJ;
};

/// Further ones are left out. Only a scene of thousands of loose things has more, and all of those are taken the same way.
inline constexpr std::size_t kMaxAffordances = 4096;

/// From the joints (turns, slides: the second body against the first) and from the agents of the types simulation.grasp (taken),
/// geometry.snap (placed) and simulation.lit (brought). Reads their parameters as a checked scenario has them, and leaves out names
/// that the world does not have.
[[nodiscard]] std::vector<Affordance> affordances_of(const WorldDescription& description);

}  // namespace mechane::state
