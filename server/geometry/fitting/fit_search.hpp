// The fit's outer part: many short runs on few points, fewer and longer ones on more, the best by distance.
#pragma once

#include <span>
#include <string>

#include "server/base/math.hpp"
#include "server/geometry/fitting/fit.hpp"
#include "server/geometry/fitting/fit_state.hpp"

namespace mechane::geometry {

struct FoundFit {
  FitState state;
  bool deformed = false;
  double score = 0;  ///< mean distance of the points, of the diagonal; of far ones no more than a cap
  std::string start;
};

struct SearchResult {
  FoundFit rigid;      ///< the best without taper and bend
  FoundFit best;       ///< that, or one with taper and bend which is better by FitConfig::deformation_gain
  int iterations = 0;  ///< of Levenberg-Marquardt, over all starts
};

/// For at least 12 finite points, whose bounding box has its middle in the origin and a diagonal of 1.
[[nodiscard]] SearchResult search_fit(std::span<const Vec3> points, const FitConfig& config);

}  // namespace mechane::geometry
