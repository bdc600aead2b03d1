// How many cells a grid needs: the fewest with which the 99th percentile of its depth error is no more than what is allowed.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "server/base/assert.hpp"
#include "tests/benchmark/collision/method.hpp"

namespace mechane::benchmark {

inline constexpr int kFewestCells = 8;
inline constexpr int kMostCells =
    192;  ///< a grid that is not good enough by then stays as it is: its error is reported

/// Distance at a point of the object's frame, negative inside.
using DistanceAt = std::function<double(const Vec3f& p_O)>;

/// The p99 of the error at points that lie inside, metres. Outside answers of inside points count as depth 0.
[[nodiscard]] inline double p99_error_m(std::span<const KnownPoint> points, const DistanceAt& distance_at) {
  std::vector<double> errors;
  for (const KnownPoint& known : points) {
    const double said = distance_at(known.p_O);
    if (known.distance_m < 0 || said < 0)
      errors.push_back(std::abs(std::min(said, 0.0) - std::min(known.distance_m, 0.0)));
  }
  if (errors.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.99 * static_cast<double>(errors.size()))) - 1;
  std::nth_element(errors.begin(), errors.begin() + rank, errors.end());
  return errors[static_cast<std::size_t>(rank)];
}

/// `error_of(cells)` builds such a grid and says its p99 error. Goes up by a quarter until it is good enough, then halves the interval.
[[nodiscard]] inline int fewest_cells(double allowed_m, const std::function<double(int cells)>& error_of) {
  int bad = kFewestCells - 1;
  int good = kFewestCells;
  while (good < kMostCells && error_of(good) > allowed_m) {
    bad = good;
    good = std::min(kMostCells, good + std::max(1, good / 4));
  }
  while (good - bad > 1) {
    const int middle = (good + bad) / 2;
    (error_of(middle) <= allowed_m ? good : bad) = middle;
  }
  return good;
}

/// Seconds since its making: what a build took, without the search for its resolution.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  }

 private:
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

}  // namespace mechane::benchmark
