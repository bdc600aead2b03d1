// A superquadric as triangles: for sampling, for tests, for showing what a fit found.
#pragma once

#include "server/geometry/mesh.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::geometry {

/// A closed mesh with vertices on the surface: a cube of 6 x cells x cells squares, each vertex moved along its ray from the centre to
/// the surface, so that small exponents leave no gaps as a grid in (eta, omega) would. `cells` >= 1.
[[nodiscard]] Mesh tessellate(const Superquadric& shape, int cells);

}  // namespace mechane::geometry
