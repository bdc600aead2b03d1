// Whether a mesh can be used at all, and whether it closes a volume.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "server/base/error.hpp"
#include "server/geometry/mesh.hpp"

namespace mechane::geometry {

inline constexpr std::size_t kMaxTriangles = 2'000'000;

/// Errors at `where`: missing (no triangles), too_large (too many), damaged (an index out of range), invalid_value (a number that is not
/// finite or beyond a kilometre, a mesh smaller than a micrometre).
[[nodiscard]] Expected<void> check_mesh(const Mesh& mesh, const std::string& where);

/// The mesh with vertices at the same place (within `tolerance_m`) made one, triangles without area left out, and one left of triangles
/// that have the same corners and look the same way. Exporters double vertices along creases and texture seams.
[[nodiscard]] Mesh weld(const Mesh& mesh, double tolerance_m);
/// The same within a millionth of its diagonal.
[[nodiscard]] Mesh weld(const Mesh& mesh);

/// Edges, as pairs of vertices, that triangles pass more often one way than the other: those around holes, and where a triangle is turned
/// against its neighbour. The mesh must be welded.
[[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> rims(const Mesh& welded);

/// How many directed edges have no partner that runs the other way: 0 means closed. The mesh must be welded.
[[nodiscard]] std::size_t open_edges(const Mesh& welded);

/// Of a closed mesh; negative where it is inside out. Overlapping pieces count as often as they overlap.
[[nodiscard]] double enclosed_volume_m3(const Mesh& mesh);

}  // namespace mechane::geometry
