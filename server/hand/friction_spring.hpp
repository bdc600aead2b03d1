// Friction of a hand on a surface, as the server and the local contact model render it.
#pragma once

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

/// The force on the hand, N: a spring from where the hand stuck, and damping, together at most `cone_n`. `stretch_m` is how far the hand
/// has gone from there along the surface; it is shortened where the spring alone would pull harder (Hayward and Armstrong 2000).
[[nodiscard]] inline Vec3 spring_friction(Vec3& stretch_m, double stiffness_n_per_m, const Vec3& damping_n,
                                          double cone_n) noexcept {
  stretch_m = stiffness_n_per_m > 0 ? at_most(stretch_m, cone_n / stiffness_n_per_m) : Vec3(Vec3::Zero());
  return -at_most(stiffness_n_per_m * stretch_m + damping_n, cone_n);
}

}  // namespace mechane::hand
