// What a surface is like beyond friction, as the server and the local contact model render it: spring, damping, grooves, viscosity.
#pragma once

#include <algorithm>
#include <cmath>

#include "server/base/math.hpp"
#include "server/hand/friction_spring.hpp"

namespace mechane::hand {

/// Even grooves: the surface lies lower by depth_m / 2 (1 + cos phase). The phase changes as a hand moves across them.
struct Grooves {
  double depth_m = 0;          ///< from ridge to bottom, >= 0; 0: the surface is smooth
  Vec3 wave_W = Vec3::Zero();  ///< across the grooves, along the surface: how fast the phase changes, rad/m
  double phase_rad = 0;        ///< where the hand is; 0 at the bottom
};

/// The most that the crests of grooves may bend, 1/m. A press of 2 N on 600 N/m then makes the surface a third stiffer sideways; a harder
/// press more, in proportion.
inline constexpr double kMaxCrest_per_m = 100;
/// The most that the flanks of grooves may rise. Steeper ones would hold a hand, and throw it.
inline constexpr double kMaxFlank = 0.5;
/// The most viscosity that a hand may meet, in all touches together, N s/m. It acts on a device's own noisy velocity.
inline constexpr double kMaxViscosity_ns_per_m = 2;

/// How deep grooves of that wave number (2 pi over their distance, rad/m) may be.
[[nodiscard]] inline double max_groove_depth_m(double wave_rad_per_m) noexcept {
  return 2 * std::min(kMaxFlank / wave_rad_per_m, kMaxCrest_per_m / (wave_rad_per_m * wave_rad_per_m));
}

/// Whether grooves can be rendered. False for what is not finite.
[[nodiscard]] inline bool are_renderable(double depth_m, double wave_rad_per_m) noexcept {
  constexpr double kRounding = 1 + 1e-5;  // of the wire's floats
  return depth_m == 0 ? std::isfinite(wave_rad_per_m)
                      : depth_m > 0 && wave_rad_per_m > 0 && depth_m <= kRounding * max_groove_depth_m(wave_rad_per_m);
}

/// A touch of a grooved surface.
struct GroovedTouch {
  double depth_m = 0;           ///< what the grooves leave of the depth, >= 0
  Vec3 flank_W = Vec3::Zero();  ///< what pushes a hand aside, as a share of the spring's force along the normal
};

/// A touch that is `depth_m` deep in the surface without its grooves. The force of a spring on what is left of the depth, with its share
/// aside, is the gradient of the spring's energy: a hand that goes over the grooves and back gets nothing out of them. `depth_share`: what
/// `depth_m` changes by when the hand goes in by 1; the grooves' height counts by as much.
[[nodiscard]] inline GroovedTouch grooved(double depth_m, const Grooves& grooves, double phase_rad,
                                          double depth_share = 1) noexcept {
  if (grooves.depth_m <= 0) return {std::max(depth_m, 0.0), Vec3::Zero()};
  const double half_m = 0.5 * grooves.depth_m;
  const double left_m = depth_m - depth_share * half_m * (1 + std::cos(phase_rad));
  if (left_m <= 0) return {};
  return {left_m, -half_m * std::sin(phase_rad) * grooves.wave_W};
}

/// How a surface resists.
struct Resistance {
  double stiffness_n_per_m = 0;
  double damping_ns_per_m = 0;    ///< of what pushes in
  double viscosity_ns_per_m = 0;  ///< along the surface
  double onset_m = 0;             ///< damping and viscosity grow to their full values over this depth: no jolt at touch
};

/// What a surface does to a hand, without friction.
struct SurfaceForce {
  double normal_n = 0;  ///< along the normal: what friction is in proportion to
  Vec3 f_W = Vec3::Zero();
};

/// Continuous in depth and velocity. `n_W`: unit, from the surface into the hand; `v_rel_W`: of the hand over the surface.
[[nodiscard]] inline SurfaceForce surface_force(const GroovedTouch& touch, const Vec3& n_W, const Vec3& v_rel_W,
                                                const Resistance& resistance) noexcept {
  const double spring_n = resistance.stiffness_n_per_m * touch.depth_m;
  const double onset = std::min(1.0, touch.depth_m / resistance.onset_m);
  const double approach = std::max(0.0, -v_rel_W.dot(n_W));
  const double normal_n = spring_n + onset * resistance.damping_ns_per_m * approach;
  const Vec3 drag_n = onset * resistance.viscosity_ns_per_m * along_surface(v_rel_W, n_W);
  return {normal_n, normal_n * n_W + spring_n * touch.flank_W - drag_n};
}

}  // namespace mechane::hand
