// The map of one part, cast against the whole solid.
#pragma once

#include <cstddef>
#include <cstdint>

#include "server/collision/radial_map.hpp"
#include "server/collision/solid.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::collision {

/// Casts the map of a part from a centre in its wood: the superquadric's own centre where that serves, else the place from which most
/// of the part's surface is seen through wood (a stave's superquadric has its centre near the hollow).
///
/// Which surface a ray belongs to: the first one that leads from the centre out into air. A ray that comes from outside, as in the
/// paper, would take whatever it meets first, so that the far wall or another part within the bound filled the air before this part.
/// The paper's two special values become: 'no hit' (the centre itself is in air this way) a surface close to the centre, sigma 16;
/// 'covered' (the bound lies in a neighbour's wood) the neighbour's surface, where the ray leaves it, so that seams make no walls.
[[nodiscard]] RadialMap cast_map(const Solid& solid, std::size_t part, const geometry::Mesh& mesh,
                                 const geometry::Superquadric& shape, const Pose& X_OQ, int resolution,
                                 std::uint64_t seed);

}  // namespace mechane::collision
