// The sparse grid of a part or of a whole object, measured on the exact mesh.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "server/collision/distance_brick.hpp"
#include "server/collision_build/cast_map.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::collision_build {

// Of exact distances to a mesh. Cosine between a face's normal and the way to its nearest point: above this, the point is not on the
// face's edge. And of the way between two places: if their distances add up to more, they lie on the same side of the surface.
inline constexpr double kOnFace = 0.9999;
inline constexpr double kSameSide = 1.0001;

struct BrickNeeds {
  double probe_depth_m = 0;  ///< down to this far under the surface the depth must be exact
  double tolerance_m = 0;    ///< a block stays coarse while no depth that is tried in it errs by more
  double share = 0;          ///< or by more than this share of itself
  double stray_m = 0;        ///< a witness deeper than this must be inside, one this far outside must not
};

/// A grid that covers `frame`, with `blocks` blocks along its longest edge. Not valid where it would be too large.
[[nodiscard]] collision::DistanceBrick::Grid brick_grid(const MapFrame& frame, int blocks);

/// A point whose exact depth is known; negative outside.
struct Probe {
  Vec3 p_O = Vec3::Zero();
  double depth_m = 0;
};

/// Chooses each block's level and measures its nodes: blocks that the surface or the layer under it does not cross stay coarse, and so
/// do those in which the distance is all but linear. Blocks in which one of the `witnesses` is answered wrongly, by more than
/// needs.stray_m, get the finest level in a second round. `solid` must be closed, `skin` its mesh where it borders on air. An empty
/// result would hold more than `at_most` bytes. Uses all cores.
[[nodiscard]] std::optional<collision::DistanceBrick> build_brick(
    const Solid& solid, const geometry::MeshQuery& skin, const Pose& X_OQ, const collision::DistanceBrick::Grid& grid,
    const BrickNeeds& needs, std::span<const Probe> witnesses, std::size_t at_most);

}  // namespace mechane::collision_build
