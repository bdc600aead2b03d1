// The radial map of one part, cast against the whole solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "server/collision/radial_map.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/pieces/cut_plane.hpp"

namespace mechane::collision_build {

/// Where a part lies in its frame Q: what its map must cover.
struct MapFrame {
  Pose X_OQ;
  Vec3 center_Q = Vec3::Zero();  ///< from where the radial map looks
  Vec3 half_Q = Vec3::Zero();    ///< around the centre; holds every point of the part
};

/// A place of the surface with its outward normal.
struct SurfacePlace {
  Vec3 p_O = Vec3::Zero();
  Vec3 n_O = Vec3::Zero();
};

/// Chooses the centre: the superquadric's own where that is good enough, else the place in the solid from which most of the part's exposed
/// surface is seen through the solid (a stave's superquadric has its centre near the hollow). `node` is the solid's part; `places`, `cell`
/// (none for the whole node) and `bound_points_O` are of its piece.
[[nodiscard]] MapFrame choose_frame(const Solid& solid, std::size_t node, std::span<const SurfacePlace> places,
                                    std::span<const geometry::HalfSpace> cell, std::span<const Vec3> bound_points_O,
                                    const Pose& X_OQ);

/// Casts the map. A ray goes out from the centre and takes the first surface that leads into air. A ray from outside, as in the paper,
/// would take the first thing that it meets: the far wall, or another part within the bound, would then fill the air in front of this
/// part. The paper's two special values become: 'no hit' (the centre itself is in air this way) a surface close to the centre, sigma
/// 16; 'covered' (the bound lies in a neighbour's solid) the neighbour's surface where the ray leaves it, so that seams make no walls.
[[nodiscard]] collision::RadialMap cast_map(const Solid& solid, const MapFrame& frame, int resolution);

}  // namespace mechane::collision_build
