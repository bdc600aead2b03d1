// The superquadric's formulas for any scalar: double, or a jet that carries derivatives.
#pragma once

#include <cmath>

#include "server/geometry/superquadric.hpp"

namespace mechane::geometry::math {

template <class T>
using Vec3T = Eigen::Matrix<T, 3, 1>;

/// sin(x)/x and (1 - cos(x))/x^2, smooth at 0.
template <class T>
[[nodiscard]] T sinc(const T& x) {
  using std::sin;
  const T x2 = x * x;
  if (x2 < 1e-8) return T(1) - x2 / T(6);
  return sin(x) / x;
}

template <class T>
[[nodiscard]] T one_minus_cos_over_square(const T& x) {
  using std::cos;
  const T x2 = x * x;
  if (x2 < 1e-6) return T(0.5) - x2 / T(24);
  return (T(1) - cos(x)) / x2;
}

/// (x/a)^2 to the power `exponent`. Zero on the axis itself, where a jet's derivative of the power would be 0 times infinity.
template <class T>
[[nodiscard]] T even_power(const T& ratio, const T& exponent) {
  using std::pow;
  const T square = ratio * ratio;
  if (square < 1e-30) return T(0);
  return pow(square, exponent);
}

/// Taper: X = (kx z/a3 + 1) x, the same for Y.
template <class T>
[[nodiscard]] Vec3T<T> taper(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  const T t = p.z() / s.a.z();
  return {(s.taper_x * t + T(1)) * p.x(), (s.taper_y * t + T(1)) * p.y(), p.z()};
}

template <class T>
[[nodiscard]] Vec3T<T> untaper(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  const T t = p.z() / s.a.z();
  return {p.x() / (s.taper_x * t + T(1)), p.y() / (s.taper_y * t + T(1)), p.z()};
}

/// Circular bend. With r = x cos(alpha) + y sin(alpha), which is the literature's cos(alpha - beta) sqrt(x^2 + y^2), and the differences
/// written out so that k = 0 is the identity with the right derivatives, not a division by zero.
template <class T>
[[nodiscard]] Vec3T<T> bend(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  using std::cos;
  using std::sin;
  const T& k = s.bend_per_m;
  const T ca = cos(s.bend_angle_rad);
  const T sa = sin(s.bend_angle_rad);
  const T r = p.x() * ca + p.y() * sa;
  const T gamma = k * p.z();
  const T rise = p.z() * p.z() * one_minus_cos_over_square(gamma);  // (1 - cos gamma) / k^2
  const T shift = k * rise * (T(1) - k * r);                        // R - r
  return {p.x() + ca * shift, p.y() + sa * shift, p.z() * sinc(gamma) * (T(1) - k * r)};
}

template <class T>
[[nodiscard]] Vec3T<T> unbend(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  using std::atan2;
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T& k = s.bend_per_m;
  const T ca = cos(s.bend_angle_rad);
  const T sa = sin(s.bend_angle_rad);
  const T R = p.x() * ca + p.y() * sa;
  const T over = T(1) - k * R;
  const T root = sqrt(over * over + k * k * p.z() * p.z());  // 1 - k r
  const T r = (T(2) * R - k * (R * R + p.z() * p.z())) / (T(1) + root);
  const T slope = k * p.z();
  const T tangent = slope / over;
  // gamma / k: near k = 0 the quotient of two small numbers becomes the arc tangent's series.
  const T z = over > 0.0 && tangent * tangent < 1e-6 ? p.z() / over * (T(1) - tangent * tangent / T(3))
                                                     : atan2(slope, over) / k;
  return {p.x() - ca * (R - r), p.y() - sa * (R - r), z};
}

template <class T>
[[nodiscard]] Vec3T<T> deform(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  return bend(s, taper(s, p));
}

template <class T>
[[nodiscard]] Vec3T<T> undeform(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  return untaper(s, unbend(s, p));
}

/// F of an undeformed point (paper, equation 1).
template <class T>
[[nodiscard]] T inside_outside_undeformed(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  using std::pow;
  const T section = even_power<T>(p.x() / s.a.x(), T(1) / s.e2) + even_power<T>(p.y() / s.a.y(), T(1) / s.e2);
  const T across = section < 1e-300 ? T(0) : pow(section, s.e2 / s.e1);
  return across + even_power<T>(p.z() / s.a.z(), T(1) / s.e1);
}

/// F^e1 (the fit's residual) of a deformed point.
template <class T>
[[nodiscard]] T residual_form(const BasicSuperquadric<T>& s, const Vec3T<T>& p) {
  using std::pow;
  const T f = inside_outside_undeformed(s, undeform(s, p));
  return f < 1e-300 ? T(0) : pow(f, s.e1);
}

}  // namespace mechane::geometry::math
