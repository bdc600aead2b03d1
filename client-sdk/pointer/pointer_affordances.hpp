// Which way a touched thing can go, from what the server says of the world: for a pointer, that has two dimensions of three.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <mechane/client/types.hpp>

namespace mechane::pointer {

/// Through p_W along the unit vector a_W.
struct AffordanceLine {
  Vec3 p_W = Vec3::Zero();
  Vec3 a_W = Vec3::UnitZ();
};

/// Where a body may be meant to go.
struct AffordanceGoal {
  Pose X_WB;
  bool turns_too = false;  ///< false: the place alone matters
};

/// What one object can do at this moment. Neither axle nor track: it goes wherever it is carried.
struct Leeway {
  bool taken = false;  ///< hands may take it
  std::optional<AffordanceLine> axle;
  std::optional<AffordanceLine> track;
  std::vector<AffordanceGoal> goals;
};

/// The pose of an object of the manifest; none: there is no such object.
using PoseOf = std::function<std::optional<Pose>(std::uint32_t object)>;

/// `affordances` as in the presentation, `enabled` the agents of the present step. A joint counts while its two sides are together. A world
/// that tells of no affordances at all lets everything be taken.
[[nodiscard]] Leeway leeway_of(std::span<const client::Affordance> affordances, std::span<const std::string> enabled,
                               std::uint32_t object, const PoseOf& pose_of);

}  // namespace mechane::pointer
