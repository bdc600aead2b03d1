// A surface without an inside, made a plate.
#pragma once

#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

/// A closed mesh around the surface, half of the thickness on either side, with a wall along each open edge. Faces that meet at an angle
/// keep the thickness up to an angle of 120 degrees. Where more than two triangles meet in an edge, each patch gets a plate of its own and
/// they overlap. The mesh must be welded.
[[nodiscard]] Mesh thickened(const Mesh& welded, double thickness_m);

}  // namespace mechane::geometry
