// Random superquadrics, points on them with noise and outliers, and how far one surface lies from another: for the fit's tests and
// its benchmark.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "server/base/math.hpp"
#include "server/base/random.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "server/geometry/surface_samples.hpp"

namespace mechane::test {

struct PlacedSuperquadric {
  geometry::Superquadric shape;
  Pose X_OQ;
};

inline double between(Random& random, double low, double high) {
  return low + (high - low) * random.unit();
}

inline double gaussian(Random& random) {
  const double radius = std::sqrt(-2 * std::log(1 - random.unit()));
  return radius * std::cos(2 * kPi * random.unit());
}

inline Vec3 gaussian_vector(Random& random) {
  const double x = gaussian(random);
  const double y = gaussian(random);
  return {x, y, gaussian(random)};
}

/// Semi-axes uniform in 1 to 8, exponents uniform in their range; half of the draws with taper, both ways uniform in -0.6 to 0.6; half
/// of them with a bend, from end to end uniform in 0 to 90 degrees, in any direction; each drawn independently. A draw that folds over
/// itself is drawn again. Any size from peg to door, any pose.
inline PlacedSuperquadric draw_superquadric(std::uint64_t seed) {
  Random random(seed);
  PlacedSuperquadric drawn;
  geometry::Superquadric& s = drawn.shape;
  do {
    s = {};
    for (double& a : s.a)
      a = between(random, 1, 8);
    s.a *= between(random, 0.01, 0.1);
    s.e1 = between(random, geometry::kMinExponent, geometry::kMaxExponent);
    s.e2 = between(random, geometry::kMinExponent, geometry::kMaxExponent);
    if (random.unit() < 0.5) {
      s.taper_x = between(random, -0.6, 0.6);
      s.taper_y = between(random, -0.6, 0.6);
    }
    if (random.unit() < 0.5) {
      s.bend_per_m = between(random, 0, 0.5 * kPi) / (2 * s.a.z());
      s.bend_angle_rad = between(random, -kPi, kPi);
    }
  } while (!geometry::is_valid(s));
  const Vec3 axis = gaussian_vector(random);
  drawn.X_OQ.R = Quat(gaussian(random), axis.x(), axis.y(), axis.z()).normalized();
  for (double& p : drawn.X_OQ.p)
    p = between(random, -2, 2);
  return drawn;
}

inline geometry::Mesh placed_mesh(const PlacedSuperquadric& placed, int cells) {
  geometry::Mesh mesh = geometry::tessellate(placed.shape, cells);
  for (Vec3& v : mesh.vertices)
    v = placed.X_OQ * v;
  return mesh;
}

/// Points spread by area over a tessellation, brought onto the true surface along the rays from its centre.
inline std::vector<Vec3> points_on(const PlacedSuperquadric& placed, const geometry::Mesh& mesh, std::size_t count,
                                   std::uint64_t seed) {
  geometry::Superquadric plain = placed.shape;
  plain.taper_x = plain.taper_y = plain.bend_per_m = 0;
  const Pose X_QO = placed.X_OQ.inverse();
  std::vector<Vec3> points;
  points.reserve(count);
  for (const geometry::SurfaceSample& sample : geometry::sample_by_area(mesh, count, seed)) {
    const Vec3 p = geometry::undeform(placed.shape, X_QO * sample.p);
    points.push_back(placed.X_OQ * geometry::deform(placed.shape, p / geometry::radial_form(plain, p)));
  }
  return points;
}

/// Gaussian noise of `noise_m` in x, y and z; then about the share `outliers` of the points goes anywhere into a box of twice the
/// points' sides.
inline void disturb(std::vector<Vec3>& points, double noise_m, double outliers, std::uint64_t seed) {
  Random random(seed);
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points)
    box.extend(p);
  for (Vec3& p : points) {
    if (noise_m > 0) p += noise_m * gaussian_vector(random);
    if (random.unit() >= outliers) continue;
    for (int i = 0; i < 3; ++i)
      p[i] = box.center()[i] + between(random, -1, 1) * box.sizes()[i];
  }
}

/// The mean distance from one surface to the other, in % of the truth's diagonal; the larger of the two directions.
inline double surface_difference_pct(const PlacedSuperquadric& truth, const PlacedSuperquadric& found, int cells,
                                     std::size_t points) {
  const geometry::Mesh true_mesh = placed_mesh(truth, cells);
  const geometry::Mesh found_mesh = placed_mesh(found, cells);
  const auto mean = [&](const std::vector<Vec3>& from, const geometry::Mesh& to) {
    const geometry::MeshQuery query(to);
    double sum = 0;
    for (const Vec3& p : from)
      sum += query.closest(p).distance_m / static_cast<double>(from.size());
    return sum;
  };
  const double there = mean(points_on(truth, true_mesh, points, 1), found_mesh);
  const double back = mean(points_on(found, found_mesh, points, 2), true_mesh);
  return 100 * std::max(there, back) / true_mesh.bounds().diagonal().norm();
}

}  // namespace mechane::test
