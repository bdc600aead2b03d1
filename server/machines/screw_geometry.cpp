#include "server/machines/screw_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "server/base/assert.hpp"
#include "server/base/math.hpp"

namespace mechane::machines {
namespace {

constexpr int kAngles = 2000;
constexpr int kRadii = 200;

}  // namespace

bool holds_water(const ScrewShape& shape) {
  return shape.slope_rad > 0 && shape.slope_rad < kPi / 2 &&
         shape.pitch_m * std::tan(shape.slope_rad) < 2 * kPi * shape.core_radius_m;
}

double volume_ratio(const ScrewShape& shape) {
  MECHANE_ASSERT(holds_water(shape) && shape.core_radius_m < shape.outer_radius_m && shape.blades > 0);
  // w goes up along the axis, x up across it. A point's height is w sin(slope) + x cos(slope); heights here are divided by sin(slope).
  // At angle phi (from x, in the sense of the blades) the lower blade is at w = pitch phi / 2 pi.
  const double cotangent = 1 / std::tan(shape.slope_rad);
  const double advance = shape.pitch_m / (2 * kPi);
  const double gap_m = shape.pitch_m / shape.blades;
  const double phi1 = std::asin(advance / (shape.core_radius_m * cotangent));
  const double level_m = advance * phi1 + shape.core_radius_m * std::cos(phi1) * cotangent;
  const double d_phi = 2 * kPi / kAngles;
  const double d_r = (shape.outer_radius_m - shape.core_radius_m) / kRadii;
  double bucket_m3 = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double phi = phi1 + (i + 0.5) * d_phi;
    const double cosine = std::cos(phi);
    for (int j = 0; j < kRadii; ++j) {
      const double r = shape.core_radius_m + (j + 0.5) * d_r;
      const double depth_m = level_m - r * cosine * cotangent - advance * phi;  // along the axis, over the lower blade
      bucket_m3 += std::clamp(depth_m, 0.0, gap_m) * r * d_r * d_phi;
    }
  }
  const double full_m3 = kPi * shape.outer_radius_m * shape.outer_radius_m * shape.pitch_m;
  return shape.blades * bucket_m3 / full_m3;
}

double volume_per_turn_m3(const ScrewShape& shape) {
  return volume_ratio(shape) * kPi * shape.outer_radius_m * shape.outer_radius_m * shape.pitch_m;
}

double muysken_limit_rad_s(double outer_diameter_m) {
  return 50.0 / std::pow(outer_diameter_m, 2.0 / 3.0) * 2 * kPi / 60;
}

}  // namespace mechane::machines
