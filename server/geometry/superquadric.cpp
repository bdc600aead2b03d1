#include "server/geometry/superquadric.hpp"

#include <algorithm>
#include <cmath>

#include <ceres/jet.h>

#include "server/geometry/superquadric_math.hpp"

namespace mechane::geometry {
namespace {

using Jet3 = ceres::Jet<double, 3>;
using JetPoint = Eigen::Matrix<Jet3, 3, 1>;

BasicSuperquadric<Jet3> constant_jets(const Superquadric& s) {
  BasicSuperquadric<Jet3> j;
  for (int i = 0; i < 3; ++i)
    j.a[i] = Jet3(s.a[i]);
  j.e1 = Jet3(s.e1);
  j.e2 = Jet3(s.e2);
  j.taper_x = Jet3(s.taper_x);
  j.taper_y = Jet3(s.taper_y);
  j.bend_per_m = Jet3(s.bend_per_m);
  j.bend_angle_rad = Jet3(s.bend_angle_rad);
  return j;
}

JetPoint variable(const Vec3& p) {
  return {Jet3(p.x(), 0), Jet3(p.y(), 1), Jet3(p.z(), 2)};
}

/// J of the deformation at an undeformed point.
Mat3 deformation_jacobian(const Superquadric& s, const Vec3& p) {
  const JetPoint deformed = math::deform<Jet3>(constant_jets(s), variable(p));
  Mat3 J;
  for (int row = 0; row < 3; ++row)
    J.row(row) = deformed[row].v.transpose();
  return J;
}

struct Trig {
  double ce, se, cw, sw;
  explicit Trig(SurfaceAngles t)
      : ce(std::max(0.0, std::cos(t.eta))), se(std::sin(t.eta)), cw(std::cos(t.omega)), sw(std::sin(t.omega)) {}
};

Vec3 undeformed_point(const Superquadric& s, const Trig& t) {
  const double c1 = signed_power(t.ce, s.e1);
  return {s.a.x() * c1 * signed_power(t.cw, s.e2), s.a.y() * c1 * signed_power(t.sw, s.e2),
          s.a.z() * signed_power(t.se, s.e1)};
}

}  // namespace

bool is_deformed(const Superquadric& s) {
  return s.taper_x != 0 || s.taper_y != 0 || s.bend_per_m != 0;
}

bool is_valid(const Superquadric& s) {
  const bool finite = s.a.allFinite() && std::isfinite(s.e1) && std::isfinite(s.e2) && std::isfinite(s.taper_x) &&
                      std::isfinite(s.taper_y) && std::isfinite(s.bend_per_m) && std::isfinite(s.bend_angle_rad);
  if (!finite || s.a.minCoeff() <= 0 || s.e1 <= 0 || s.e1 > 2 || s.e2 <= 0 || s.e2 > 2) return false;
  if (std::abs(s.taper_x) >= 1 || std::abs(s.taper_y) >= 1 || s.bend_per_m < 0) return false;
  // The widest section after the taper must stay on one side of the bend's axis.
  const double widest = std::hypot(s.a.x() * (1 + std::abs(s.taper_x)), s.a.y() * (1 + std::abs(s.taper_y)));
  return s.bend_per_m * widest < 1 && s.bend_per_m * s.a.z() < kPi;
}

double inside_outside(const Superquadric& s, const Vec3& p_QP) {
  return math::inside_outside_undeformed<double>(s, is_deformed(s) ? undeform(s, p_QP) : p_QP);
}

double radial_form(const Superquadric& s, const Vec3& p_QP) {
  return std::pow(inside_outside(s, p_QP), 0.5 * s.e1);
}

Vec3 gradient(const Superquadric& s, const Vec3& p_QP) {
  const BasicSuperquadric<Jet3> shape = constant_jets(s);
  const JetPoint p = variable(p_QP);
  return math::inside_outside_undeformed<Jet3>(shape, is_deformed(s) ? math::undeform<Jet3>(shape, p) : p).v;
}

Vec3 surface_point(const Superquadric& s, SurfaceAngles angles) {
  const Vec3 p = undeformed_point(s, Trig(angles));
  return is_deformed(s) ? deform(s, p) : p;
}

SurfaceTangents surface_tangents(const Superquadric& s, SurfaceAngles angles) {
  const Trig t(angles);
  const double c1 = std::pow(t.ce, s.e1);
  const double d1 = -s.e1 * std::pow(t.ce, s.e1 - 1) * t.se;  // d(cos^e1)/d eta
  const double cw = signed_power(t.cw, s.e2);
  const double sw = signed_power(t.sw, s.e2);
  SurfaceTangents r;
  r.eta = Vec3(s.a.x() * d1 * cw, s.a.y() * d1 * sw, s.a.z() * s.e1 * std::pow(std::abs(t.se), s.e1 - 1) * t.ce);
  r.omega = Vec3(-s.a.x() * c1 * s.e2 * std::pow(std::abs(t.cw), s.e2 - 1) * t.sw,
                 s.a.y() * c1 * s.e2 * std::pow(std::abs(t.sw), s.e2 - 1) * t.cw, 0);
  if (!is_deformed(s)) return r;
  const Mat3 J = deformation_jacobian(s, undeformed_point(s, t));
  return {J * r.eta, J * r.omega};
}

Vec3 surface_normal(const Superquadric& s, SurfaceAngles angles) {
  const Trig t(angles);
  const double c1 = std::pow(t.ce, 2 - s.e1);
  const Vec3 n(c1 * signed_power(t.cw, 2 - s.e2) / s.a.x(), c1 * signed_power(t.sw, 2 - s.e2) / s.a.y(),
               signed_power(t.se, 2 - s.e1) / s.a.z());
  if (!is_deformed(s)) return n.normalized();
  const Mat3 J = deformation_jacobian(s, undeformed_point(s, t));
  return (J.determinant() * (J.inverse().transpose() * n)).normalized();
}

SurfaceAngles angles_of(const Superquadric& s, const Vec3& p_QP) {
  const Vec3 p = is_deformed(s) ? undeform(s, p_QP) : p_QP;
  const double c = signed_power(p.x() / s.a.x(), 1 / s.e2);
  const double d = signed_power(p.y() / s.a.y(), 1 / s.e2);
  // hypot(c, d) is cos(eta)^(e1/e2), up to the point's distance from the surface.
  const double across = std::pow(std::hypot(c, d), s.e2 / s.e1);
  return {std::atan2(signed_power(p.z() / s.a.z(), 1 / s.e1), across), std::atan2(d, c)};
}

Vec3 deform(const Superquadric& s, const Vec3& p_undeformed) {
  return math::deform<double>(s, p_undeformed);
}
Vec3 undeform(const Superquadric& s, const Vec3& p_QP) {
  return math::undeform<double>(s, p_QP);
}

}  // namespace mechane::geometry
