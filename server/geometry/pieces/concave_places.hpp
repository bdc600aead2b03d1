// Where a surface is concave: creases of the mesh, and smooth necks and grooves. People see the borders of parts there (minima rule,
// Hoffman & Singh 1997).
#pragma once

#include <cstdint>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/distance_grid.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

struct ConcavePlace {
  Vec3 p = Vec3::Zero();
  Vec3 across = Vec3::Zero();  ///< unit, tangential: the most concave direction
  Vec3 along = Vec3::Zero();   ///< unit, tangential: the crease, or the bottom of the groove
  Vec3 face_a = Vec3::Zero();  ///< normals of the two faces of a crease; zero where the surface is smooth
  Vec3 face_b = Vec3::Zero();
  double weight = 0;  ///< bending angle times length or width, in units of the diagonal
};

/// The strongest places first, no more than a few thousand. `mesh` must be welded and closed, with some extent.
[[nodiscard]] std::vector<ConcavePlace> find_concave_places(const Mesh& mesh, const DistanceGrid& grid,
                                                            std::uint64_t seed);

}  // namespace mechane::geometry
