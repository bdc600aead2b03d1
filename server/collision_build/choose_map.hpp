// Which representation a part gets: the smallest that meets the error budget, measured against the exact mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "server/collision/part_map.hpp"
#include "server/collision_build/build_brick.hpp"
#include "server/collision_build/cast_map.hpp"
#include "server/collision_build/solid.hpp"
#include "server/geometry/mesh.hpp"
#include "server/geometry/mesh_query.hpp"

namespace mechane::collision_build {

/// Absolute bounds, metres.
struct ErrorBudget {
  double depth_p99_m = 0;    ///< of the depth, at the 99th percentile
  double missed_m = 0;       ///< no point deeper than this may be missed, none this far outside may be a contact
  double probe_depth_m = 0;  ///< how deep points are asked
};

/// How exact a map's answers are, over points just under the surface and just above it. Infinite if there was no point to ask.
struct MapError {
  double p50_m = 0;
  double p99_m = std::numeric_limits<double>::infinity();
  double max_m = std::numeric_limits<double>::infinity();
  std::size_t probes = 0;
  std::size_t missed = 0;  ///< points deeper than missed_m that the map calls outside
  std::size_t wrong = 0;   ///< points further outside than missed_m that it calls inside
  /// For choosing where no map meets the budget: the lesser is the better. Missing one point in fifty is as bad as twice the error.
  [[nodiscard]] double badness_m() const {
    return p99_m * (1 + 50 * static_cast<double>(missed + wrong) / static_cast<double>(probes + 1));
  }
  /// `stray`: the share of the probes that may be missed or wrong.
  [[nodiscard]] bool meets(const ErrorBudget& budget, double stray = 0) const {
    return p99_m <= budget.depth_p99_m && static_cast<double>(missed + wrong) <= stray * static_cast<double>(probes);
  }
};

struct MapCandidates {
  bool radial = true;
  bool brick = true;
  int only_resolution = 0;           ///< of a radial map; 0: any
  std::size_t more_than = 0;         ///< bytes: only larger maps
  std::size_t at_most = 128U << 10;  ///< bytes
  std::span<const Probe> must = {};  ///< points none of which may be missed or wrong, besides the budget
  double but_for = 0;                ///< except for this share of them
  /// Of bricks, where it is tighter than that of radial maps, whose X_OQ it shares; null: the same.
  const MapFrame* brick_frame = nullptr;
  const geometry::Mesh* field_of = nullptr;  ///< the skin's mesh: a DistanceField of it comes before the others
};

struct MapChoice {
  collision::PartMap map;
  MapError error;
  bool met = false;
};

/// Points up to `budget.probe_depth_m` under and above the places of a node, with their exact depths; less deep where the solid is thin.
/// Places whose normal does not lead from solid into air (seams) are left out.
[[nodiscard]] std::vector<Probe> make_probes(const Solid& solid, const geometry::MeshQuery& skin,
                                             std::span<const SurfacePlace> places, const ErrorBudget& budget,
                                             std::size_t count, std::uint64_t seed);

using Ask = std::function<collision::MapHit(const Vec3& p_O)>;
[[nodiscard]] MapError measure(std::span<const Probe> probes, const ErrorBudget& budget, const Ask& ask);

/// Tries a field, if one is allowed, of several block sizes, and takes the smallest that meets the budget. Else it tries the
/// candidates of either other kind from the smallest on. A few points that the part alone gets wrong may pass: its neighbours overlap
/// it, and the whole object is measured afterwards. Where none meets the budget: the one with the least error, `met` false; an empty map
/// where no candidate is left.
[[nodiscard]] MapChoice choose_map(const Solid& solid, const geometry::MeshQuery& skin, const MapFrame& frame,
                                   std::span<const Probe> probes, const ErrorBudget& budget,
                                   const MapCandidates& candidates);

}  // namespace mechane::collision_build
