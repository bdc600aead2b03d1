// Whether the fit finds random shapes again, as bench_fit measures it on many more, and what it does with points that are not finite.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/geometry/fitting/fit.hpp"
#include "tests/support/superquadric_draw.hpp"

namespace mechane::geometry {
namespace {

constexpr int kCells = 24;

FitConfig for_scans() {
  FitConfig config;
  config.robust = true;
  config.bound = false;
  config.deformation_gain = 0.02;
  return config;
}

std::vector<Vec3> scan(const test::PlacedSuperquadric& truth, double noise_pct, double outliers, std::uint64_t seed) {
  const Mesh mesh = test::placed_mesh(truth, kCells);
  std::vector<Vec3> points = test::points_on(truth, mesh, 2000, seed);
  test::disturb(points, 0.01 * noise_pct * mesh.bounds().diagonal().norm(), outliers, seed);
  return points;
}

/// How many of `draws` shapes lie within 1 % of the diagonal, in the mean.
int recovered(int draws, double noise_pct, double outliers) {
  int count = 0;
  for (int i = 0; i < draws; ++i) {
    const auto seed = static_cast<std::uint64_t>(5000 + i);
    const test::PlacedSuperquadric truth = test::draw_superquadric(seed);
    const auto fit = fit_superquadric(scan(truth, noise_pct, outliers, seed), for_scans());
    if (!fit) continue;
    count += test::surface_difference_pct(truth, {fit->shape, fit->X_OQ}, kCells, 800) < 1 ? 1 : 0;
  }
  return count;
}

TEST(FitRecovery, FindsCleanShapesAgain) {
  EXPECT_GE(recovered(20, 0, 0), 19);
}

TEST(FitRecovery, AFifthOfOutliersDoesNotPull) {
  EXPECT_GE(recovered(20, 0, 0.2), 18);
}

TEST(FitRecovery, FindsShapesUnderNoise) {
  EXPECT_GE(recovered(12, 3, 0), 9);
}

TEST(FitRecovery, NoiseDoesNotThickenAPlate) {
  // Least squares of distances finds the thin axis a third to half too long, and round edges; the exact number is the noise's.
  test::PlacedSuperquadric plate;
  plate.shape.a = {0.05, 0.3, 0.4};
  plate.shape.e1 = plate.shape.e2 = 0.3;
  FitConfig plain = for_scans();
  plain.robust = false;
  double off_pct = 0;
  double plain_off_pct = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<Vec3> points = scan(plate, 3, 0, seed);
    const auto fit = fit_superquadric(points, for_scans());
    const auto plain_fit = fit_superquadric(points, plain);
    ASSERT_TRUE(fit && plain_fit);
    off_pct += test::surface_difference_pct(plate, {fit->shape, fit->X_OQ}, kCells, 800) / 5;
    plain_off_pct += test::surface_difference_pct(plate, {plain_fit->shape, plain_fit->X_OQ}, kCells, 800) / 5;
  }
  EXPECT_LT(off_pct, 0.6 * plain_off_pct);
  EXPECT_LT(off_pct, 1);
}

TEST(FitRecovery, SameSeedSameBits) {
  const std::vector<Vec3> points = scan(test::draw_superquadric(3), 1, 0.1, 3);
  const auto once = fit_superquadric(points, for_scans());
  const auto again = fit_superquadric(points, for_scans());
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->shape.a, again->shape.a);
  EXPECT_EQ(once->shape.bend_angle_rad, again->shape.bend_angle_rad);
  EXPECT_EQ(once->X_OQ.R.coeffs(), again->X_OQ.R.coeffs());
  EXPECT_EQ(once->report.hausdorff_pct, again->report.hausdorff_pct);
}

TEST(FitRecovery, BoundsOnlyWhenAsked) {
  const test::PlacedSuperquadric truth = test::draw_superquadric(11);
  std::vector<Vec3> points = scan(truth, 0, 0, 11);
  points.emplace_back(truth.X_OQ * (1.5 * truth.shape.a));  // one stray point
  FitConfig config = for_scans();
  const auto loose = fit_superquadric(points, config);
  config.bound = true;
  const auto tight = fit_superquadric(points, config);
  ASSERT_TRUE(loose && tight);
  EXPECT_EQ(loose->report.bound_scale, 1);
  EXPECT_GT(tight->report.bound_scale, 1.1);
  EXPECT_GT(inside_outside(loose->shape, loose->X_OQ.inverse() * points.back()), 1);
  for (const Vec3& p : points)
    EXPECT_LE(inside_outside(tight->shape, tight->X_OQ.inverse() * p), 1);
}

TEST(FitRecovery, TheHausdorffDistanceSeesTheCornersOfAWedge) {
  Mesh wedge = tessellate({{0.2, 0.1, 0.1}, 0.1, 0.1}, 12);
  for (Vec3& v : wedge.vertices)
    v.z() *= 1 + 4 * v.x();
  FitConfig config;
  config.deformations = false;
  const auto fit = fit_superquadric(wedge, config);
  ASSERT_TRUE(fit.has_value());
  EXPECT_GE(fit->report.hausdorff_pct, fit->report.max_pct);
  EXPECT_GT(fit->report.hausdorff_pct, 5);
  EXPECT_LT(fit->report.hausdorff_pct, 40);
}

TEST(FitRecovery, WhatIsNoPointIsNamed) {
  const std::vector<Vec3> good = scan(test::draw_superquadric(1), 0, 0, 1);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300, 1e7}) {
    std::vector<Vec3> points = good;
    points[42].y() = bad;
    const auto fit = fit_superquadric(points, for_scans());
    ASSERT_FALSE(fit);
    EXPECT_EQ(fit.error().code, ErrorCode::invalid_value);
    EXPECT_NE(fit.error().what.find("42"), std::string::npos);
    EXPECT_FALSE(fit.error().remedy.empty());
  }
  EXPECT_FALSE(fit_superquadric(std::vector<Vec3>{}, for_scans()));
  EXPECT_FALSE(fit_superquadric(std::vector<Vec3>(500, Vec3(1, 2, 3)), for_scans()));
}

TEST(FitRecovery, PointsGivenManyTimesAreStillTheShape) {
  const test::PlacedSuperquadric truth = test::draw_superquadric(2);
  std::vector<Vec3> points = scan(truth, 0, 0, 2);
  points.resize(400);
  for (int times = 0; times < 9; ++times)
    points.insert(points.end(), points.begin(), points.begin() + 400);
  const auto fit = fit_superquadric(points, for_scans());
  ASSERT_TRUE(fit.has_value());
  EXPECT_TRUE(is_valid(fit->shape));
}

RC_GTEST_PROP(FitRecovery, AnyPointsGiveAValidShapeOrAnError, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const std::size_t count = *rc::gen::inRange<std::size_t>(0, 60);
  const double size = std::pow(10.0, test::between(random, -6, 2.5));
  const double flatness = std::pow(10.0, test::between(random, -5, 0));
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p = size * test::gaussian_vector(random).cwiseMin(3).cwiseMax(-3);
    points.emplace_back(p.x(), p.y(), flatness * p.z());
    if (random.unit() < 0.3) points.push_back(points.front());
  }
  FitConfig config;
  config.robust = random.unit() < 0.5;
  config.bound = random.unit() < 0.5;
  const auto fit = fit_superquadric(points, config);
  if (!fit) {
    RC_ASSERT(!fit.error().what.empty());
    return;
  }
  RC_ASSERT(is_valid(fit->shape));
  RC_ASSERT(fit->X_OQ.p.allFinite() && std::abs(fit->X_OQ.R.norm() - 1) < 1e-9);
  RC_ASSERT(std::isfinite(fit->report.hausdorff_pct) && std::isfinite(fit->report.mean_pct));
}

}  // namespace
}  // namespace mechane::geometry
