// Shells that lie inside out, turned round.
#pragma once

#include <cstddef>

#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

/// Turns every closed shell that encloses a negative volume and does not lie inside another: a shell inside another is the wall of a
/// hollow, and its normals point into that. Shells are triangles that share vertices. Returns how many were turned (0: nothing was
/// touched). The mesh must be welded and finite, its indices in range.
[[nodiscard]] std::size_t turn_outwards(Mesh& welded);

}  // namespace mechane::geometry
