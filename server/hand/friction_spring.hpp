// Friction of a hand on a surface, as the server and the local contact model render it.
#pragma once

#include <algorithm>

#include "server/base/math.hpp"

namespace mechane::hand {

/// `v` shortened to at most `limit`.
[[nodiscard]] inline Vec3 at_most(const Vec3& v, double limit) noexcept {
  const double norm = v.norm();
  return norm > limit ? Vec3(v * (limit / norm)) : v;
}

/// What is left of `v` without its part along the unit normal `n`.
[[nodiscard]] inline Vec3 along_surface(const Vec3& v, const Vec3& n) noexcept {
  return v - v.dot(n) * n;
}

/// The friction that a touch can have, N: the static one until the spring from where the hand stuck pulls harder, then the dynamic one
/// until the hand goes back. Changes `slides`.
[[nodiscard]] inline double friction_cone_n(bool& slides, double pull_n, double static_n, double dynamic_n) noexcept {
  constexpr double kSticksAgain = 0.9;  // share of the stretch: the hand went back, and it is not only a sensor's noise
  static_n = std::max(static_n, dynamic_n);
  slides = slides ? pull_n > kSticksAgain * dynamic_n : pull_n > static_n;
  return slides ? dynamic_n : static_n;
}

/// The force on the hand, N: a spring from where the hand stuck, and damping, together at most `cone_n`. `stretch_m` is how far the hand
/// has gone from there along the surface; it is shortened where the spring alone would pull harder (Hayward and Armstrong 2000).
[[nodiscard]] inline Vec3 spring_friction(Vec3& stretch_m, double stiffness_n_per_m, const Vec3& damping_n,
                                          double cone_n) noexcept {
  stretch_m = stiffness_n_per_m > 0 ? at_most(stretch_m, cone_n / stiffness_n_per_m) : Vec3(Vec3::Zero());
  return -at_most(stiffness_n_per_m * stretch_m + damping_n, cone_n);
}

}  // namespace mechane::hand
