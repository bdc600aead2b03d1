// The exact distance to a mesh at the nodes of a grid.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "tests/benchmark/collision/solid_query.hpp"

namespace mechane::benchmark {

/// Coordinates of the nodes along each axis, ascending.
using GridAxes = std::array<std::vector<double>, 3>;

/// Signed distance, metres, negative inside; x fastest. On all cores.
[[nodiscard]] std::vector<double> exact_distances(const SolidQuery& query, const GridAxes& axes);

}  // namespace mechane::benchmark
