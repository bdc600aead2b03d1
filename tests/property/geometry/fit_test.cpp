#include "server/geometry/fitting/fit.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/sanitizers.hpp"

namespace mechane::geometry {
namespace {

double unit() {
  return *rc::gen::inRange(-1000, 1001) / 1000.0;
}

RC_GTEST_PROP(Fit, WhateverItReturnsBoundsThePoints, ()) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  std::vector<Vec3> points;
  const Vec3 size(0.05 + std::abs(unit()), 0.05 + std::abs(unit()), 0.05 + std::abs(unit()));
  const int count = *rc::gen::inRange(12, 60);
  for (int i = 0; i < count; ++i)
    points.push_back(Vec3(unit(), unit(), unit()).cwiseProduct(size));
  const auto fit = fit_superquadric(points);
  if (!fit) {
    RC_ASSERT(!fit.error().what.empty() && !fit.error().remedy.empty());
    return;
  }
  RC_ASSERT(is_valid(fit->shape));
  RC_ASSERT(fit->shape.e1 >= kMinExponent && fit->shape.e1 <= kMaxExponent);
  RC_ASSERT(fit->shape.e2 >= kMinExponent && fit->shape.e2 <= kMaxExponent);
  const Pose X_QO = fit->X_OQ.inverse();
  for (const Vec3& p : points)
    RC_ASSERT(inside_outside(fit->shape, X_QO * p) <= 1);
}

}  // namespace
}  // namespace mechane::geometry
