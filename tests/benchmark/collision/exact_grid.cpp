#include "tests/benchmark/collision/exact_grid.hpp"

#include <atomic>
#include <cmath>
#include <thread>

namespace mechane::benchmark {
namespace {

/// One line of nodes along x. Distance changes by no more than the way between two nodes: that bounds the search from one to the next,
/// and where two distances together are longer than the way, no surface lies between, so the side is the same.
void fill_row(const SolidQuery& query, const std::vector<double>& xs, double y, double z, double* out) {
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const Vec3 p(xs[i], y, z);
    const double way = i == 0 ? 0 : xs[i] - xs[i - 1];
    const double before = i == 0 ? 0 : std::abs(out[i - 1]);
    const double distance =
        i == 0 ? query.closest(p).distance_m : query.closest(p, (before + way) * (1 + 1e-9) + 1e-12).distance_m;
    const bool same_side = i > 0 && before + distance > way * (1 + 1e-9);
    const bool inside = same_side ? out[i - 1] < 0 : query.winding(p) > 0;
    out[i] = inside ? -distance : distance;
  }
}

}  // namespace

std::vector<double> exact_distances(const SolidQuery& query, const GridAxes& axes) {
  const std::size_t nx = axes[0].size();
  const std::size_t rows = axes[1].size() * axes[2].size();
  std::vector<double> distances(nx * rows);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t row = next++; row < rows; row = next++)
      fill_row(query, axes[0], axes[1][row % axes[1].size()], axes[2][row / axes[1].size()], &distances[row * nx]);
  };
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i)
    others.emplace_back(work);
  work();
  others.clear();
  return distances;
}

}  // namespace mechane::benchmark
