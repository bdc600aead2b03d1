// How a touched thing can move, from the server's affordances: for a pointer, which has two of the three dimensions.
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

/// A place where a body may be put.
struct AffordanceGoal {
  Pose X_WB;
  bool turns_too = false;  ///< false: only the position matters
};

/// How one object can move at this moment. Without axle and track, it can be carried anywhere.
struct Leeway {
  bool taken = false;  ///< hands can take it
  std::optional<AffordanceLine> axle;
  std::optional<AffordanceLine> track;
  std::vector<AffordanceGoal> goals;
};

/// Gives the pose of an object of the manifest; none: there is no such object.
using PoseOf = std::function<std::optional<Pose>(std::uint32_t object)>;

/// The object with this number in the manifest; null if the manifest does not have it.
[[nodiscard]] const client::SceneObject* object_of(std::span<const client::SceneObject> objects, std::uint32_t object);

/// Where an object is: as the frame says, or as it was laid out. `frame` is null until the first one has come.
[[nodiscard]] std::optional<Pose> pose_in(const client::Frame* frame, std::span<const client::SceneObject> objects,
                                          std::uint32_t object);

/// `affordances` is from the presentation, `enabled` has the enabled agents of the present step. A joint counts while
/// its two sides are together. In a world without any affordances, everything can be taken.
[[nodiscard]] Leeway leeway_of(std::span<const client::Affordance> affordances, std::span<const std::string> enabled,
                               std::uint32_t object, const PoseOf& pose_of);

}  // namespace mechane::pointer
