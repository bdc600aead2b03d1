// The shells of a mesh: triangles that hang together.
#pragma once

#include <cstdint>
#include <vector>

#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

using Shell = std::vector<std::uint32_t>;  ///< triangles, ascending

/// Triangles that share vertices, in the order of their first triangles. The mesh must be welded.
[[nodiscard]] std::vector<Shell> shells_of(const Mesh& welded);

/// The triangles of one shell as a mesh without other vertices.
[[nodiscard]] Mesh mesh_of(const Mesh& mesh, const Shell& shell);

/// Turns single triangles so that neighbours across an edge run the same way, as far as edges of two triangles lead; in each such patch the
/// lesser area is turned. Returns how many were turned. The mesh must be welded.
[[nodiscard]] std::size_t make_consistent(Mesh& welded);

/// Patches of triangles that hang together across edges of exactly two triangles which run the same way. Each is orientable.
[[nodiscard]] std::vector<Shell> patches_of(const Mesh& welded);

}  // namespace mechane::geometry
