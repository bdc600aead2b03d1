// What a surface is like beyond stiffness and friction: its grooves and its viscosity, as the server and the local contact model render them.
#pragma once

#include <cmath>

#include "server/base/math.hpp"

namespace mechane::hand {

/// Even grooves: the surface lies lower by depth_m / 2 (1 + cos phase), and the phase changes with the way of a hand over it.
struct Grooves {
  double depth_m = 0;          ///< from ridge to bottom, >= 0; 0: the surface is smooth
  Vec3 wave_W = Vec3::Zero();  ///< across the grooves: how fast the phase changes, rad/m
  double phase_rad = 0;        ///< where the hand is; 0 at the bottom
};

/// The most that the crests of grooves may bend, 1/m: at 2 N on 600 N/m, the stiffness along the surface is then a third of the surface's
/// own, so that a device that renders the one renders the other.
inline constexpr double kMaxCrest_per_m = 100;
/// The most that the flanks of grooves may rise. Steeper ones would hold a hand, and throw it.
inline constexpr double kMaxFlank = 0.5;

/// Whether grooves of that depth and wave number (2 pi over their distance, rad/m) can be rendered. False for what is not finite.
[[nodiscard]] inline bool are_renderable(double depth_m, double wave_rad_per_m) noexcept {
  constexpr double kRounding = 1 + 1e-5;  // of the wire's floats
  const double flank = 0.5 * depth_m * wave_rad_per_m;
  return depth_m >= 0 && wave_rad_per_m >= 0 && flank <= kRounding * kMaxFlank &&
         flank * wave_rad_per_m <= kRounding * kMaxCrest_per_m;
}

/// The most viscosity that a surface may have, N s/m. It acts on a device's own noisy velocity.
inline constexpr double kMaxViscosity_ns_per_m = 2;

/// A touch of a grooved surface.
struct GroovedTouch {
  double depth_m = 0;           ///< what the grooves leave of the depth, >= 0
  Vec3 flank_W = Vec3::Zero();  ///< what a hand is pushed aside with, as a share of the spring's force along the normal
};

/// A touch that is `depth_m` deep in the surface without its grooves, at a phase. The force of a spring on what is left of the depth, with
/// its share aside, is the gradient of the spring's energy: a hand that goes over the grooves and back gets nothing out of them.
[[nodiscard]] inline GroovedTouch grooved(double depth_m, const Grooves& grooves, double phase_rad) noexcept {
  const double half_m = 0.5 * grooves.depth_m;
  const double left_m = depth_m - half_m * (1 + std::cos(phase_rad));
  if (left_m <= 0) return {};
  return {left_m, -half_m * std::sin(phase_rad) * grooves.wave_W};
}

}  // namespace mechane::hand
