#include "server/geometry/surface_samples.hpp"

#include <gtest/gtest.h>

#include "server/geometry/mesh_query.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::geometry {
namespace {

TEST(SurfaceSamples, ByAreaEachFaceGetsItsShare) {
  const Mesh mesh = test::box({0.5, 1, 2});
  EXPECT_DOUBLE_EQ(surface_area_m2(mesh), 2 * (1 * 2 + 1 * 4 + 2 * 4));
  const auto samples = sample_by_area(mesh, 7000, 1);
  ASSERT_EQ(samples.size(), 7000U);
  int top = 0;
  int right = 0;
  for (const auto& s : samples) {
    top += s.p.z() > 2 - 1e-9 ? 1 : 0;
    right += s.p.x() > 0 ? 1 : 0;
  }
  EXPECT_NEAR(top, 500, 2);       // 2 of 28 square metres, stratified
  EXPECT_NEAR(right, 3500, 120);  // uniform within a face
}

TEST(SurfaceSamples, BySpacingTheyKeepApartAndCover) {
  const Mesh mesh = test::cylinder(0.05, 0.1, 32);
  const double spacing = 0.01;
  const auto samples = sample_by_spacing(mesh, spacing, 1);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE((samples[i].p - samples[j].p).norm(), 0.7 * spacing);
  }
  for (const auto& place : sample_by_area(mesh, 3000, 99)) {
    double nearest = 1;
    for (const auto& s : samples)
      nearest = std::min(nearest, (s.p - place.p).norm());
    EXPECT_LT(nearest, spacing);
  }
}

TEST(SurfaceSamples, SameSeedSamePointsAndOnlyWhereAccepted) {
  const Mesh mesh = test::box({0.1, 0.1, 0.1});
  const auto upper = [](const SurfaceSample& s) { return s.p.z() > 0; };
  const auto once = sample_by_spacing(mesh, 0.02, 4, upper);
  const auto again = sample_by_spacing(mesh, 0.02, 4, upper);
  ASSERT_EQ(once.size(), again.size());
  ASSERT_GT(once.size(), 50U);
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].p, again[i].p);
    EXPECT_GT(once[i].p.z(), 0);
  }
}

TEST(SurfaceSamples, NothingFromNothing) {
  EXPECT_TRUE(sample_by_area({}, 10, 1).empty());
  EXPECT_TRUE(sample_by_spacing({}, 0.01, 1).empty());
}

}  // namespace
}  // namespace mechane::geometry
