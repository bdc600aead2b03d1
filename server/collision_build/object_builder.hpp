// Makes an Object from meshes, or from a superquadric. Slow (seconds): offline, or while a scenario loads; never in a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/collision/object.hpp"
#include "server/collision_build/choose_map.hpp"
#include "server/geometry/fitting/fit.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/solid/solid_mesh.hpp"

namespace mechane::collision_build {

/// Where an object's parts come from. If a mesh is cut into pieces, one brick of the whole may replace them when it is exact and small
/// enough; parts that an author gave are kept.
enum class Parts {
  automatic,   ///< several meshes: each is a part; a single one is decomposed
  as_given,    ///< each mesh is a part
  decomposed,  ///< each mesh is cut into pieces close to convex
};

/// What gives a part its frame and its bound: the superquadric that is fitted to it; or, for comparison, its tight box.
enum class Bounds { superquadrics, boxes };

struct BuildConfig {
  Parts parts = Parts::automatic;
  geometry::SolidChoice solid;  ///< what is inside, where a mesh is open or is a sheet
  double max_concavity = 0.02;  ///< of a piece, as a share of its mesh's diagonal; see geometry::decompose
  std::size_t max_pieces = 48;  ///< of one mesh
  int grid_cells = 64;          ///< of the grid on which pieces are searched; see geometry::DecomposeConfig
  /// The error budget: a map's depth error at its 99th percentile, as a share of the object's diagonal, and in metres; the lesser holds.
  double max_error_share = 0.003;
  double max_error_m = 0.001;    ///< what a finger still takes for the real surface
  double miss_share = 0.002;     ///< of the diagonal: no point deeper than this, or than max_error_m, may be missed
  double probe_depth_m = 0.004;  ///< how deep the error is measured: a finger that presses hard sinks in this far
  bool radial_maps = true;       ///< what the builder may choose from
  bool bricks = true;
  bool fields =
      false;  ///< one DistanceField for each mesh, uncut, where that meets the budget; see deploy/decisions/037-fields.md
  Bounds bounds = Bounds::superquadrics;
  int map_resolution = 0;                   ///< of radial maps: one of RadialMap::kResolutions; 0: chosen
  double sample_spacing_m = 0.005;          ///< between surface samples; under a third of a fingertip
  std::size_t max_samples_per_part = 4096;  ///< a part that would need more gets a wider spacing instead
  double seam_gap_m = 0.001;                ///< gaps between parts up to this width count as solid, not as a slot
  std::uint64_t seed = 1;                   ///< same meshes, config and seed: same object, to the bit
};

/// The result for one part.
struct PartReport {
  std::string name;
  geometry::FitReport fit;
  std::size_t samples = 0;
  double spacing_m = 0;  ///< of the samples, after the cap
  std::string map;       ///< see PartMap::name
  std::size_t bytes = 0;
  MapError error;    ///< of this part's map by itself, against the exact distance to the object's mesh
  bool met = false;  ///< the budget
};

struct BuildReport {
  std::vector<PartReport> parts;
  std::vector<geometry::SolidMesh> solids;  ///< of each mesh: what the parts were made from
  double diagonal_m = 0;
  ErrorBudget budget;
  MapError error;         ///< of the whole object, as a query answers
  std::size_t bytes = 0;  ///< of all maps
  double seconds = 0;
};

/// Is told how many parts of how many are ready, by the threads that build; calls may overlap.
using PartDone = std::function<void(std::size_t done, std::size_t parts)>;

/// Decomposes, fits, maps and samples meshes in the object's frame O. A part gets the smallest map that meets the error budget, and the
/// report says where none does. Each mesh becomes a solid first (make_solid). Parts that touch or overlap make one solid: seams are neither
/// mapped nor sampled. Errors name the part: no triangles, NaN, flat, enclosing nothing, too many parts or triangles.
/// `report` may be null. Uses all cores.
[[nodiscard]] Expected<collision::Object> build_object(std::span<const geometry::NamedMesh> parts,
                                                       const BuildConfig& config, BuildReport* report = nullptr,
                                                       const PartDone& on_part = {});

}  // namespace mechane::collision_build
