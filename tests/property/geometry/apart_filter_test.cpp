#include "server/geometry/apart_filter.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"

namespace mechane::geometry {
namespace {

/// Of a cube of six least distances. Half of the points lie on a grid: on borders of cells, and just as far apart as they must be.
Vec3 any_point(double least_m) {
  const bool on_grid = *rc::gen::arbitrary<bool>();
  Vec3 p;
  for (double& v : p)
    v = least_m * (on_grid ? *rc::gen::inRange(-3, 4) : *test::between(-3, 3));
  return p;
}

RC_GTEST_PROP(ApartFilter, RefusesJustThosePointsThatAreTooNearToOneBefore, ()) {
  const double least_m = *test::between(1e-3, 0.2);
  ApartFilter filter(least_m);
  std::vector<Vec3> kept;
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = any_point(least_m);
    const auto is_far = [&](const Vec3& q) { return (q - p).squaredNorm() >= least_m * least_m; };
    const bool apart = std::ranges::all_of(kept, is_far);
    RC_ASSERT(filter.is_apart(p) == apart);
    if (!apart) continue;
    filter.put(p);
    kept.push_back(p);
  }
}

}  // namespace
}  // namespace mechane::geometry
