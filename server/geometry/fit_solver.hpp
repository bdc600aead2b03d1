// The fit's inner part: parameters in a form that cannot leave their ranges, and Levenberg-Marquardt on them.
#pragma once

#include <array>
#include <span>

#include "server/base/math.hpp"
#include "server/geometry/superquadric.hpp"

namespace mechane::geometry {

/// Parameters of one superquadric in some frame, for points whose diagonal is about 1:
/// log of the axes (3), exponents (2) through a sigmoid, rotation vector from `base` (3), centre (3), taper (2) through tanh, curvature
/// and its angle (2).
struct FitState {
  static constexpr int kRigid = 11;
  static constexpr int kAll = 15;
  Quat base = Quat::Identity();
  std::array<double, kAll> x{};

  [[nodiscard]] static FitState start(const Pose& X_OQ, const Vec3& half, double e1, double e2);
  /// Starts taper at none and the bend at `bend_per_m` (not 0, where its angle has no derivative) towards `angle_rad`.
  void begin_deformation(double bend_per_m, double angle_rad);

  [[nodiscard]] Superquadric shape() const;
  [[nodiscard]] Pose pose() const;
};

struct FitErrors {
  double mean = 0;
  double rms = 0;
  double max = 0;
};

/// Levenberg-Marquardt on equation 3; returns the iterations it took. `deformed`: all 15 parameters, else the first 11.
int improve(FitState& state, std::span<const Vec3> points, int max_iterations, bool deformed);

/// Distances of the points to the surface: the lesser of the way along the ray from the centre and the first-order distance
/// |f - 1| / |grad f| with f = F^(e1/2). Infinite where the parameters make no valid shape.
[[nodiscard]] FitErrors fit_errors(const FitState& state, std::span<const Vec3> points);

}  // namespace mechane::geometry
