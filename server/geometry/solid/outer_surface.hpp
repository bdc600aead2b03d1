// The parts of a mesh's triangles that border on air on one side and on solid on the other.
#pragma once

#include <array>
#include <vector>

#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::geometry {

struct OuterSurface {
  std::vector<std::vector<std::array<Vec3, 3>>>
      pieces;               ///< of each triangle; one that is wholly outside has itself alone
  std::vector<bool> whole;  ///< the triangle is not cut, nor left out
  std::vector<Vec3> cuts;   ///< places where triangles were cut
};

/// Outer is a place with a winding number below 0.5 before it and above 0.5 behind it. Triangles are asked at points about 1/48 of the
/// diagonal apart and cut to a thousandth of it. `query` must be of `mesh`, inside by winding number. Uses all cores.
[[nodiscard]] OuterSurface outer_surface(const Mesh& mesh, const MeshQuery& query);

/// The winding number right before a place of the surface, on the side of the unit normal n. Right behind it, it is greater by 1.
[[nodiscard]] double winding_before(const MeshQuery& query, const Vec3& p, const Vec3& n, double diagonal_m);

}  // namespace mechane::geometry
