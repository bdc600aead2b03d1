// Cuts a solid into pieces that are close to convex, where people see the borders of its parts: at concave creases and necks, by
// short cuts, about what protrudes (minima rule and part salience, Hoffman & Singh 1997). The mesh itself is not cut: a piece is the
// solid within some half-spaces. Top-down as V-HACD (Mamou 2016) and CoACD (Wei et al. 2022) do it, with concavity measured on chords.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/pieces/cut_plane.hpp"

namespace mechane::geometry {

struct DecomposeConfig {
  /// Of the object's diagonal, 0.001 to 1: how far straight lines between points of a piece may leave the solid.
  double max_concavity = 0.02;
  std::size_t max_parts = 48;  ///< 1 to 1000
  int grid_cells = 64;         ///< along the longest edge, of the distance grid that the search uses: 8 to 256
  std::uint64_t seed = 1;
};

/// The solid inside all half-spaces of `cell`; none where the piece is the whole solid. Frame and units are the mesh's.
struct Piece {
  std::vector<HalfSpace> cell;
  std::vector<Vec3>
      surface_points;  ///< on the object's surface, spread evenly by area; none where pieces of the mesh overlap
  std::vector<Vec3> cut_points;  ///< on the cutting planes, inside the solid
  double concavity_pct = 0;      ///< of the object's diagonal, over sampled chords; 100 for a sheet
  double volume_m3 = 0;          ///< from the grid's voxels; 0 for a sheet
};

struct Decomposition {
  std::vector<Piece> pieces;
  bool met = false;  ///< every piece is within max_concavity, by the chords that were sampled
};

/// Same mesh, config and seed: the same pieces, to the bit, on any number of cores. Slow (about a second); any thread; uses all cores.
/// `progress` hears a share from 0 to 1, on the calling thread, and may be empty.
///
/// Closed pieces of mesh that overlap are one solid. Bodies that lie in one cell but do not touch (found by flooding the grid; gaps
/// below two of its cells are not seen) are parted by further cuts, even where their concavity is small. Small holes are
/// closed, as MeshQuery::contains does by winding number; an open mesh that encloses no volume comes back as one piece with met = false.
/// Errors: what check_mesh refuses, a mesh without extent, a closed one that is inside out or encloses no volume, settings out of range.
[[nodiscard]] Expected<Decomposition> decompose(const Mesh& mesh, const DecomposeConfig& config,
                                                const std::function<void(double share)>& progress = {});

}  // namespace mechane::geometry
