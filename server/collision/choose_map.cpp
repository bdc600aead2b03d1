#include "server/collision/choose_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "server/geometry/random.hpp"

namespace mechane::collision {
namespace {

// Cells of a brick along its longest edge.
constexpr std::array<int, 8> kBrickCells = {8, 12, 16, 24, 32, 48, 64, 96};
constexpr std::size_t kMaxBrickBytes = 128U << 10;
// More missed points than this mean that no centre sees the part whole: a finer radial map would not either.
constexpr double kBlindShare = 0.02;
constexpr double kStrayShare = 0.005;
// Of a probe's depth, to find the inside of a thin wall: 4 mm become 0.06 mm.
constexpr int kHalvings = 7;
// A brick's values beyond this many cells from the surface are cut off there: nobody asks so deep, and the step gets finer.
constexpr double kBandCells = 4;

/// A map that could be made, by what it would take.
struct Candidate {
  std::size_t bytes = 0;
  int resolution = 0;  // of a radial map, or 0
  int cells = 0;       // of a brick, or 0
  DistanceBrick::Grid grid;
};

/// What the last map of one kind showed, to spare the making of those that cannot do.
struct Trend {
  int fineness = 0;
  MapError error;

  /// Errors fall with the square of the fineness at best, on smooth surfaces.
  [[nodiscard]] bool rules_out(int finer, const ErrorBudget& budget) const {
    if (fineness == 0) return false;
    const double gain = static_cast<double>(finer) / fineness;
    return error.p99_m > budget.depth_p99_m * gain * gain;
  }
  [[nodiscard]] bool is_blind() const {
    return static_cast<double>(error.missed) > kBlindShare * static_cast<double>(error.probes);
  }
};

DistanceBrick::Grid grid_of(const MapFrame& frame, int cells) {
  DistanceBrick::Grid grid;
  const double cell = 2 * frame.half_Q.maxCoeff() / cells;
  Vec3 size;
  for (Eigen::Index i = 0; i < 3; ++i) {
    // A margin of half a cell or more on each side, so that the surface is nowhere at the very edge.
    const double count = std::ceil(2 * frame.half_Q[i] / cell) + 1;
    grid.nodes[static_cast<std::size_t>(i)] = static_cast<int>(count) + 1;
    size[i] = count * cell;
  }
  grid.cell_m = static_cast<float>(cell);
  grid.origin_Q = (frame.center_Q - 0.5 * size).cast<float>();
  return grid;
}

std::vector<Candidate> list_candidates(const MapFrame& frame, bool closed, const MapCandidates& allowed) {
  std::vector<Candidate> list;
  for (const int n : RadialMap::kResolutions) {
    if (!allowed.radial || (allowed.only_resolution != 0 && allowed.only_resolution != n)) continue;
    list.push_back({static_cast<std::size_t>(6 * n * n) * sizeof(std::uint16_t), n, 0, {}});
  }
  for (const int cells : kBrickCells) {
    if (!allowed.brick || !closed) break;  // an open mesh has no inside
    const DistanceBrick::Grid grid = grid_of(frame, cells);
    std::size_t bytes = sizeof(std::int16_t);
    for (const int n : grid.nodes)
      bytes *= static_cast<std::size_t>(n);
    if (*std::max_element(grid.nodes.begin(), grid.nodes.end()) > DistanceBrick::kMaxNodes) break;
    if (bytes <= kMaxBrickBytes) list.push_back({bytes, 0, cells, grid});
  }
  std::stable_sort(list.begin(), list.end(), [](const Candidate& l, const Candidate& r) { return l.bytes < r.bytes; });
  return list;
}

DistanceBrick make_brick(const Solid& solid, const geometry::MeshQuery& skin, const MapFrame& frame,
                         const DistanceBrick::Grid& grid, double probe_depth_m) {
  const double band = std::max(kBandCells * static_cast<double>(grid.cell_m), 1.5 * probe_depth_m);
  std::vector<float> distances;
  bool inside = false;
  bool sign_known = false;  // the node before lies more than a cell from the surface: this one is on the same side
  for (int z = 0; z < grid.nodes[2]; ++z) {
    for (int y = 0; y < grid.nodes[1]; ++y) {
      for (int x = 0; x < grid.nodes[0]; ++x) {
        const Vec3 p_Q = grid.origin_Q.cast<double>() + static_cast<double>(grid.cell_m) * Vec3(x, y, z);
        const Vec3 p_O = frame.X_OQ * p_Q;
        const double distance = std::min(skin.closest(p_O, band).distance_m, band);
        if (!sign_known || x == 0) inside = solid.contains(p_O);
        sign_known = distance > static_cast<double>(grid.cell_m);
        distances.push_back(static_cast<float>(inside ? -distance : distance));
      }
    }
  }
  return DistanceBrick::from_distances(grid, static_cast<float>(band), distances);
}

}  // namespace

std::vector<Probe> make_probes(const Solid& solid, const geometry::MeshQuery& skin, std::size_t node,
                               std::span<const SurfacePlace> places, const ErrorBudget& budget, std::size_t count,
                               std::uint64_t seed) {
  geometry::Random random(seed);
  std::vector<Probe> probes;
  const std::size_t step = std::max<std::size_t>(1, places.size() / count);
  for (std::size_t i = 0; i < places.size(); i += step) {
    // Two under the surface for one above it.
    double depth = budget.probe_depth_m * (probes.size() % 3 == 2 ? -random.unit() : random.unit());
    for (int halvings = 0; halvings < kHalvings; ++halvings, depth *= 0.5) {
      const Vec3 p = places[i].p_O - depth * places[i].n_O;
      const geometry::SurfacePoint nearest = skin.closest(p);
      const bool inside =
          solid.is_closed(node) ? solid.contains(p) : skin.triangle_normal(nearest.triangle).dot(p - nearest.p) < 0;
      if (inside != (depth > 0)) continue;
      probes.push_back({p, depth > 0 ? nearest.distance_m : -nearest.distance_m});
      break;
    }
  }
  return probes;
}

MapError measure(std::span<const Probe> probes, const ErrorBudget& budget, const Ask& ask) {
  MapError error;
  std::vector<double> errors;
  for (const Probe& probe : probes) {
    const MapHit hit = ask(probe.p_O);
    const double depth = hit.hit ? static_cast<double>(hit.depth_m) : 0.0;
    if (!hit.hit && probe.depth_m > budget.missed_m) ++error.missed;
    if (hit.hit && probe.depth_m < -budget.missed_m) ++error.wrong;
    if (hit.hit || probe.depth_m > 0) errors.push_back(std::abs(depth - probe.depth_m));
  }
  error.probes = probes.size();
  if (probes.empty()) return error;
  if (errors.empty()) {
    error.p99_m = error.max_m = 0;
    return error;
  }
  std::sort(errors.begin(), errors.end());
  error.p50_m = errors[errors.size() / 2];
  error.p99_m = errors[errors.size() * 99 / 100];
  error.max_m = errors.back();
  return error;
}

MapChoice choose_map(const Solid& solid, const geometry::MeshQuery& skin, std::size_t node, const MapFrame& frame,
                     std::span<const Probe> probes, const ErrorBudget& budget, const MapCandidates& candidates) {
  MapChoice best;
  const Pose X_QO = frame.X_OQ.inverse();
  Trend radial;
  Trend brick;
  for (const Candidate& candidate : list_candidates(frame, solid.is_closed(node), candidates)) {
    if (candidate.bytes <= candidates.more_than || candidate.bytes > candidates.at_most) continue;
    MapChoice tried;
    const bool is_radial = candidate.resolution > 0;
    Trend& trend = is_radial ? radial : brick;
    const int fineness = std::max(candidate.resolution, candidate.cells);
    if (trend.rules_out(fineness, budget) || (is_radial && radial.fineness >= 16 && radial.is_blind())) continue;
    if (is_radial) {
      tried.map = cast_map(solid, node, frame, candidate.resolution);
    } else {
      tried.map = make_brick(solid, skin, frame, candidate.grid, budget.probe_depth_m);
    }
    const Ask ask = [&](const Vec3& p_O) { return tried.map.evaluate((X_QO * p_O).cast<float>()); };
    tried.error = measure(probes, budget, ask);
    trend = {fineness, tried.error};
    const MapError must = measure(candidates.must, budget, ask);
    tried.met = tried.error.meets(budget, kStrayShare) && must.missed + must.wrong == 0;
    tried.error.missed += must.missed;
    tried.error.wrong += must.wrong;
    tried.error.probes += must.probes;
    if (best.map.empty() || tried.met || tried.error.badness_m() < best.error.badness_m()) best = std::move(tried);
    if (best.met || probes.empty()) break;
  }
  return best;
}

}  // namespace mechane::collision
