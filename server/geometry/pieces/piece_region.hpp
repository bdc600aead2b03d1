// A piece in the making: the solid within a convex cell, its surface, its volume, and how concave it is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/distance_grid.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/pieces/chord_table.hpp"
#include "server/geometry/pieces/cut_plane.hpp"
#include "server/geometry/pieces/piece_surface.hpp"

namespace mechane::geometry {

/// What all pieces of one object ask: its mesh, welded and closed, and the distance to it.
struct DecomposeModel {
  DecomposeModel(Mesh welded, double max_concavity, int grid_cells, std::uint64_t seed);

  Mesh mesh;
  MeshQuery query;
  DistanceGrid grid;
  Eigen::AlignedBox3d box;
  double diagonal_m = 0;
  double bound_m = 0;       ///< the concavity that a piece may have
  double volume_scale = 1;  ///< true volume of the solid over that of its voxels
  std::uint64_t seed = 1;
};

/// A node of the grid whose cube lies in the solid and in the piece, with the share that does.
struct Voxel {
  std::uint32_t node = 0;
  float share = 0;
};

struct PieceRegion {
  std::vector<HalfSpace> cell;
  PieceSurface surface;
  std::vector<Voxel> voxels;
  std::vector<Vec3> points;  ///< on the surface and, a few, on the cuts
  ChordTable chords;         ///< between the points; chords between separate lumps are raised above the bound
  double concavity_m = 0;
  int lumps = 1;  ///< separate bodies of voxels within the cell, crumbs not counted

  [[nodiscard]] bool needs_cut(const DecomposeModel& model) const { return lumps > 1 || concavity_m > model.bound_m; }
  [[nodiscard]] double volume_m3(const DecomposeModel& model) const;
};

[[nodiscard]] PieceRegion whole_region(const DecomposeModel& model);

/// The region on the plane's own side, and that beyond. Only the surface and the voxels; `measure` does the rest.
[[nodiscard]] std::pair<PieceRegion, PieceRegion> divide(const DecomposeModel& model, const PieceRegion& region,
                                                         const HalfSpace& plane);

/// The region within more half-spaces.
[[nodiscard]] PieceRegion confined(const DecomposeModel& model, const PieceRegion& region,
                                   std::span<const HalfSpace> more);

/// Fills points, chords, concavity and lumps: with few points where these already show that it must be cut, else with more.
void measure(const DecomposeModel& model, PieceRegion& region);

/// Points on the surface, away from places where pieces of the mesh overlap.
[[nodiscard]] std::vector<Vec3> surface_points(const DecomposeModel& model, const PieceRegion& region,
                                               std::size_t count);

/// Points inside the solid on the cell's planes, about `spacing_m` apart, at most `most` a plane.
[[nodiscard]] std::vector<Vec3> cut_points(const DecomposeModel& model, std::span<const HalfSpace> cell,
                                           double spacing_m, std::size_t most);

}  // namespace mechane::geometry
