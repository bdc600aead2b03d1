#include "server/collision_build/choose_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "server/base/random.hpp"
#include "server/collision_build/build_field.hpp"

namespace mechane::collision_build {
namespace {

// How many blocks a brick may have along its longest edge.
constexpr std::array<int, 11> kBrickBlocks = {2, 3, 4, 6, 8, 11, 16, 22, 32, 45, 64};
// The same for fields, whose blocks are halved where they must be.
constexpr std::array<int, 10> kFieldBlocks = {6, 8, 10, 12, 15, 19, 24, 32, 45, 64};
// A field may take this many times the bytes of the smallest that meets the budget: fine blocks cull better and are halved less often.
constexpr double kFieldGrowth = 1.35;
// Of the lesser bound: the error that a block's level may have at its nodes, so that places between them stay within the budget too.
constexpr double kBlockTolerance = 0.5;
constexpr double kFieldTolerance = 0.4;  // the same for a field's leaves, of which a few places may err by more
// Of a depth: by how much it may err deep down, as long as the budget allows. In a concave corner sheets give too small a depth.
constexpr double kDepthShare = 0.2;
// If a larger share is missed, no centre sees the whole part, and a finer radial map would not help.
constexpr double kBlindShare = 0.02;
constexpr double kStrayShare = 0.005;
// How many depths are tried to find the inside of a thin wall, each half of the one before: from 4 mm down to 0.06 mm.
constexpr int kHalvings = 7;
// The most bytes of a brick where even the finest cannot meet the budget.
constexpr std::size_t kMostWithoutHope = 524'288;

/// The results of the last map of one kind, to avoid making maps that cannot be good enough.
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

/// The candidates of one part, tried one after the other.
class Trials {
 public:
  Trials(const Solid& solid, const geometry::MeshQuery& skin, const MapFrame& frame, std::span<const Probe> probes,
         const ErrorBudget& budget, const MapCandidates& allowed)
      : solid_(solid),
        skin_(skin),
        frame_(frame),
        X_QO_(frame.X_OQ.inverse()),
        probes_(probes),
        budget_(budget),
        allowed_(allowed) {}

  void try_radial_maps() {
    Trend trend;
    for (const int n : collision::RadialMap::kResolutions) {
      const std::size_t bytes = static_cast<std::size_t>(6 * n * n) * sizeof(std::uint16_t);
      if (allowed_.only_resolution != 0 && allowed_.only_resolution != n) continue;
      if (bytes <= allowed_.more_than || bytes > allowed_.at_most) continue;
      // If no radial map can be good enough, a brick will be; without bricks the finest radial map is the best there is.
      const bool hopeless = trend.rules_out(collision::RadialMap::kResolutions.back(), budget_);
      if (trend.rules_out(n, budget_) && (!hopeless || may_try_bricks())) continue;
      if (trend.fineness >= 16 && trend.is_blind()) return;
      trend = judge(cast_map(solid_, frame_, n), n);
      if (is_done()) return;
    }
  }

  /// Tries bricks that are smaller than the best map so far.
  void try_bricks() {
    const MapFrame& frame = allowed_.brick_frame != nullptr ? *allowed_.brick_frame : frame_;
    Trend trend;
    for (const int n : kBrickBlocks) {
      const bool hopeless = trend.rules_out(kBrickBlocks.back(), budget_);
      if (trend.rules_out(n, budget_) && !hopeless) continue;
      const collision::DistanceBrick::Grid grid = brick_grid(frame, n);
      if (!collision::DistanceBrick::is_valid(grid)) return;
      const std::size_t most = hopeless ? std::min(allowed_.at_most, kMostWithoutHope) : allowed_.at_most;
      const std::size_t limit = best_.met ? std::min(most, best_.map.bytes() - 1) : most;
      std::optional<collision::DistanceBrick> brick =
          build_brick(solid_, skin_, frame_.X_OQ, grid, needs(kBlockTolerance), allowed_.must, limit);
      if (!brick) return;  // a finer one is larger
      if (brick->bytes() <= allowed_.more_than) continue;
      trend = judge(std::move(*brick), n);
      if (best_.met && best_.map.brick() != nullptr) return;
    }
  }

  /// From coarse blocks, which are halved more often, to fine ones: the bytes fall, then they rise. The finest that is still small wins.
  void try_fields() {
    const FieldSource source{solid_, skin_, *allowed_.field_of, frame_.X_OQ};
    std::size_t most = allowed_.at_most;
    for (const int n : kFieldBlocks) {
      const collision::DistanceField::Grid grid = brick_grid(frame_, n);
      if (!collision::DistanceBrick::is_valid(grid)) return;
      auto field = build_field(source, grid, needs(kFieldTolerance), allowed_.must, most);
      if (!field && best_.met) return;
      if (!field) continue;
      const auto bytes = static_cast<double>(field->bytes());
      judge(std::move(*field), n);
      if (best_.met) most = std::min(most, static_cast<std::size_t>(kFieldGrowth * bytes));
    }
  }

  [[nodiscard]] bool may_try_bricks() const { return allowed_.brick; }
  [[nodiscard]] MapChoice take() { return std::move(best_); }
  [[nodiscard]] bool is_done() const { return !best_.map.empty() && (best_.met || probes_.empty()); }

 private:
  [[nodiscard]] BrickNeeds needs(double tolerance) const {
    return {budget_.probe_depth_m, tolerance * std::min(budget_.depth_p99_m, budget_.missed_m),
            std::min(kDepthShare, budget_.depth_p99_m / budget_.probe_depth_m), budget_.missed_m};
  }

  Trend judge(collision::PartMap map, int fineness) {
    MapChoice tried;
    tried.map = std::move(map);
    const Ask ask = [&](const Vec3& p_O) { return tried.map.evaluate((X_QO_ * p_O).cast<float>()); };
    tried.error = measure(probes_, budget_, ask);
    const Trend trend{fineness, tried.error};
    const MapError must = measure(allowed_.must, budget_, ask);
    const double stray = allowed_.but_for * static_cast<double>(must.probes);
    tried.met = tried.error.meets(budget_, kStrayShare) && static_cast<double>(must.missed + must.wrong) <= stray;
    tried.error.missed += must.missed;
    tried.error.wrong += must.wrong;
    tried.error.probes += must.probes;
    const bool lesser = !best_.met && tried.error.badness_m() < best_.error.badness_m();
    if (best_.map.empty() || tried.met || lesser) best_ = std::move(tried);
    return trend;
  }

  const Solid& solid_;
  const geometry::MeshQuery& skin_;
  const MapFrame& frame_;
  Pose X_QO_;
  std::span<const Probe> probes_;
  const ErrorBudget& budget_;
  const MapCandidates& allowed_;
  MapChoice best_;
};

}  // namespace

std::vector<Probe> make_probes(const Solid& solid, const geometry::MeshQuery& skin,
                               std::span<const SurfacePlace> places, const ErrorBudget& budget, std::size_t count,
                               std::uint64_t seed) {
  Random random(seed);
  std::vector<Probe> probes;
  geometry::SurfacePoint nearest;
  const std::size_t step = std::max<std::size_t>(1, places.size() / count);
  for (std::size_t i = 0; i < places.size(); i += step) {
    // Two under the surface for one above it.
    double depth = budget.probe_depth_m * (probes.size() % 3 == 2 ? -random.unit() : random.unit());
    for (int halvings = 0; halvings < kHalvings; ++halvings, depth *= 0.5) {
      const Vec3 p = places[i].p_O - depth * places[i].n_O;
      nearest = skin.closest(p, nearest);
      if (solid.contains(p) != (depth > 0)) continue;
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
    const collision::MapHit hit = ask(probe.p_O);
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

MapChoice choose_map(const Solid& solid, const geometry::MeshQuery& skin, const MapFrame& frame,
                     std::span<const Probe> probes, const ErrorBudget& budget, const MapCandidates& candidates) {
  Trials trials(solid, skin, frame, probes, budget, candidates);
  if (candidates.field_of != nullptr) trials.try_fields();
  if (trials.is_done()) return trials.take();
  if (candidates.radial) trials.try_radial_maps();
  const bool asked_once = probes.empty() && trials.is_done();
  if (trials.may_try_bricks() && !asked_once) trials.try_bricks();
  return trials.take();
}

}  // namespace mechane::collision_build
