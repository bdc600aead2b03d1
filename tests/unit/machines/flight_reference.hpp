// Flight with quadratic drag by a method of its own, to hold machines against: fourth-order Runge-Kutta at a tenth of a tick.
#pragma once

#include <algorithm>
#include <cmath>

#include "server/base/math.hpp"

namespace mechane::machines::test {

struct Landing {
  double range_m = 0;
  double time_s = 0;
  double height_m = 0;
  double speed_m_s = 0;
};

/// From a height over the ground, at `speed` and `elevation`; deceleration k v^2, k in 1/m.
inline Landing integrate_flight(double speed_m_s, double elevation, double k_per_m, double from_m) {
  using Vec4 = Eigen::Vector4d;  // x, y, their velocities
  const auto rate = [&](const Vec4& s) {
    const double v = std::hypot(s[2], s[3]);
    return Vec4(s[2], s[3], -k_per_m * v * s[2], -9.81 - k_per_m * v * s[3]);
  };
  Vec4 s(0, from_m, speed_m_s * std::cos(elevation), speed_m_s * std::sin(elevation));
  Landing landing;
  const double h = 1e-4;
  while (s[1] > 0) {
    const Vec4 a = rate(s), b = rate(s + h / 2 * a), c = rate(s + h / 2 * b), d = rate(s + h * c);
    s += h / 6 * (a + 2 * b + 2 * c + d);
    landing.time_s += h;
    landing.height_m = std::max(landing.height_m, s[1] - from_m);
  }
  landing.range_m = s[0];
  landing.speed_m_s = std::hypot(s[2], s[3]);
  return landing;
}

}  // namespace mechane::machines::test
