// What noise does to a fit: points scattered about a thin or sharp surface make it look thicker and rounder than it is.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "server/base/math.hpp"
#include "server/geometry/fitting/fit_solver.hpp"
#include "server/geometry/fitting/fit_state.hpp"

namespace mechane::geometry {

/// The standard deviation of distances if most are Gaussian, from a quantile that
/// outliers do not reach. At least the smallest scale that a loss can use.
[[nodiscard]] double spread_of(std::span<const double> distances);

/// About `wanted` of the points, evenly chosen, without those that have far fewer neighbours than most.
[[nodiscard]] std::vector<Vec3> among_others(std::span<const Vec3> points, std::size_t wanted);

/// Points of a state's own surface, evenly over a cube around it, with the area that each stands for.
struct OwnSurface {
  std::vector<Vec3> points_O;
  std::vector<double> areas;
  double area = 0;
};
[[nodiscard]] OwnSurface own_surface(const FitState& state, int cells);

/// How far a state's surface lies from the nearest points.
struct Stray {
  double mean_beyond = 0;  ///< over its area; only what lies beyond `reach`
  double max = 0;
};
[[nodiscard]] Stray stray_of(const FitState& state, std::span<const Vec3> points, double reach);

/// Noise makes the best fit to points too thick and too round. From such a fit, finds the state whose own points, spread by area and made
/// as noisy, would have this best fit. Returns the iterations.
int remove_noise_bias(FitState& state, std::span<const Vec3> points, const ImproveConfig& config, std::uint64_t seed);

}  // namespace mechane::geometry
