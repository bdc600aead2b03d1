// Where the fit begins: frames, sizes, taper and bend read from the moments of the points.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/fitting/fit_state.hpp"

namespace mechane::geometry {

struct FitStart {
  FitState state;
  bool deformed = false;
  int z_axis = 0;  ///< which of the frame's axes became z
  std::string name;
};

/// The middle and the principal axes of points, right-handed, longest spread last; without the `trimmed` share that lies farthest out.
struct Moments {
  Vec3 mean = Vec3::Zero();
  Vec3 variance = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
};
[[nodiscard]] Moments moments_of(std::span<const Vec3> points, double trimmed);

/// Starts for each axis as z and for several exponents, without taper and bend, or (`deformed`) with those that the moments show.
/// `given`: along the axes of the points' frame too, because a modelled part often lies along them, and the moments of a cube show no
/// axes.
[[nodiscard]] std::vector<FitStart> fit_starts(std::span<const Vec3> points, bool deformed, double trimmed, bool given);

}  // namespace mechane::geometry
