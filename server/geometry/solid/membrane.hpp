// Skins over the holes of a mesh: where its winding number passes one half through free air.
#pragma once

#include <span>

#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::geometry {

/// Triangles of the surface of winding number 0.5 where it is not the mesh's own surface, outer sides towards the lesser number. Found by
/// following that surface from the mesh's open edges and from `seeds`, places where it leaves the mesh, through cubes of `cell_m`. `query`
/// must be of `mesh`, inside by winding number. The same triangles on each machine; uses all cores.
[[nodiscard]] Mesh membranes(const Mesh& mesh, const MeshQuery& query, std::span<const Vec3> seeds, double cell_m);

}  // namespace mechane::geometry
