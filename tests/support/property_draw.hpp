// What properties draw in every room: numbers between bounds, directions.
#pragma once

#include <cmath>

#include <rapidcheck.h>

#include "server/base/math.hpp"

namespace mechane::test {

inline rc::Gen<double> between(double low, double high) {
  return rc::gen::map(rc::gen::inRange(0, 1'000'001), [=](int i) { return low + (high - low) * i / 1e6; });
}

/// Evenly over the sphere.
inline Vec3 any_unit() {
  const double z = *between(-1, 1);
  const double angle = *between(-kPi, kPi);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

}  // namespace mechane::test
