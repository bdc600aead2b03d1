#include "server/geometry/superquadric.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"

namespace mechane::geometry {
namespace {

using test::between;

rc::Gen<Superquadric> shapes(bool deformed) {
  return rc::gen::exec([=] {
    Superquadric s;
    s.a = Vec3(*between(0.01, 0.5), *between(0.01, 0.5), *between(0.01, 0.5));
    s.e1 = *between(kMinExponent, kMaxExponent);
    s.e2 = *between(kMinExponent, kMaxExponent);
    if (!deformed) return s;
    s.taper_x = *between(-0.8, 0.8);
    s.taper_y = *between(-0.8, 0.8);
    // Within the bounds of the round trip: k r < 1 over the part and |k z| < pi.
    const double widest = std::hypot(s.a.x() * (1 + std::abs(s.taper_x)), s.a.y() * (1 + std::abs(s.taper_y)));
    s.bend_per_m = *between(0, 0.9) * std::min(1 / widest, kPi / s.a.z());
    s.bend_angle_rad = *between(-kPi, kPi);
    return s;
  });
}

/// Angles away from the edges, where the tangents of small exponents have no bound.
SurfaceAngles any_angles() {
  const int quarter = *rc::gen::inRange(-2, 2);
  const int half = *rc::gen::inRange(0, 2);
  const double eta = *between(0.12, kPi / 2 - 0.12);
  return {half == 0 ? eta : -eta, kPi / 2 * quarter + *between(0.12, kPi / 2 - 0.12)};
}

RC_GTEST_PROP(Superquadric, PointsOfTheSurfaceLieOnF1, (bool deformed)) {
  const Superquadric s = *shapes(deformed);
  RC_ASSERT(is_valid(s));
  const Vec3 p = surface_point(s, any_angles());
  // F's slope grows like 1/e: ask the radial form, which is a length.
  RC_ASSERT(std::abs(radial_form(s, p) - 1) < 1e-9);
}

RC_GTEST_PROP(Superquadric, TangentsAreTheDerivativesOfThePoint, (bool deformed)) {
  const Superquadric s = *shapes(deformed);
  const SurfaceAngles t = any_angles();
  const double h = 1e-5;
  const SurfaceTangents analytic = surface_tangents(s, t);
  const Vec3 eta = (surface_point(s, {t.eta + h, t.omega}) - surface_point(s, {t.eta - h, t.omega})) / (2 * h);
  const Vec3 omega = (surface_point(s, {t.eta, t.omega + h}) - surface_point(s, {t.eta, t.omega - h})) / (2 * h);
  const double size = s.a.maxCoeff();
  RC_ASSERT((analytic.eta - eta).norm() < 1e-5 * size);
  RC_ASSERT((analytic.omega - omega).norm() < 1e-5 * size);
}

RC_GTEST_PROP(Superquadric, NormalIsOrthogonalToBothTangentsAndPointsOut, (bool deformed)) {
  const Superquadric s = *shapes(deformed);
  const SurfaceAngles t = any_angles();
  const Vec3 n = surface_normal(s, t);
  const SurfaceTangents r = surface_tangents(s, t);
  RC_PRE(r.eta.norm() > 1e-12 && r.omega.norm() > 1e-12);
  RC_ASSERT(std::abs(n.norm() - 1) < 1e-12);
  RC_ASSERT(std::abs(n.dot(r.eta.normalized())) < 1e-7);
  RC_ASSERT(std::abs(n.dot(r.omega.normalized())) < 1e-7);
  // The gradient of F is another road to the same direction.
  RC_ASSERT(gradient(s, surface_point(s, t)).normalized().dot(n) > 1 - 1e-6);
}

RC_GTEST_PROP(Superquadric, FDecreasesAlongMinusN, (bool deformed)) {
  const Superquadric s = *shapes(deformed);
  const SurfaceAngles t = any_angles();
  const Vec3 p = surface_point(s, t);
  const Vec3 n = surface_normal(s, t);
  const double step = 1e-5 * s.a.minCoeff();
  RC_ASSERT(inside_outside(s, p - step * n) < inside_outside(s, p));
  RC_ASSERT(inside_outside(s, p + step * n) > inside_outside(s, p));
}

RC_GTEST_PROP(Superquadric, UndeformUndoesDeform, ()) {
  const Superquadric s = *shapes(true);
  const Vec3 p = Vec3(*between(-1, 1), *between(-1, 1), *between(-1, 1)).cwiseProduct(s.a);
  RC_ASSERT((undeform(s, deform(s, p)) - p).norm() < 1e-9);
}

RC_GTEST_PROP(Superquadric, ASlightBendIsNearlyNone, ()) {
  Superquadric s = *shapes(false);
  s.bend_angle_rad = *between(-kPi, kPi);
  const Vec3 p = Vec3(*between(-1, 1), *between(-1, 1), *between(-1, 1)).cwiseProduct(s.a);
  for (const double k : {0.0, 1e-12, 1e-9, 1e-6, 1e-4}) {
    s.bend_per_m = k;
    RC_ASSERT((deform(s, p) - p).norm() <= 2 * k * s.a.squaredNorm());
    RC_ASSERT((undeform(s, deform(s, p)) - p).norm() < 1e-12);
  }
}

RC_GTEST_PROP(Superquadric, AnglesOfAPointLeadBackToIt, (bool deformed)) {
  const Superquadric s = *shapes(deformed);
  const Vec3 p = surface_point(s, any_angles());
  RC_ASSERT((surface_point(s, angles_of(s, p)) - p).norm() < 1e-7 * s.a.maxCoeff());
}

}  // namespace
}  // namespace mechane::geometry
