#include "server/collision/radial_map.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "server/collision/superquadric_object.hpp"

namespace mechane::collision {
namespace {

/// sigma of the box with half sizes `box` about the map's centre.
RadialMap box_map(int n, const Vec3& half, const Vec3& box) {
  std::vector<float> sigma;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < n * n; ++i) {
      const Vec3 d = RadialMap::texel_direction(n, half.cast<float>(), face, i % n, i / n);
      sigma.push_back(static_cast<float>(d.cwiseAbs().cwiseQuotient(box).maxCoeff()));
    }
  }
  return RadialMap::from_sigma(n, Vec3f::Zero(), half.cast<float>(), sigma);
}

TEST(RadialMap, FlatFacesAreExactAlsoInACubeThatIsScaledOtherwise) {
  const Vec3 box(0.05, 0.03, 0.01);
  const RadialMap map = box_map(32, {0.08, 0.04, 0.013}, box);
  for (const Vec3f& p : {Vec3f(0.01F, 0.01F, 0.009F), Vec3f(0.03F, -0.02F, 0.0085F), Vec3f(-0.02F, 0.005F, 0.007F)}) {
    const MapHit hit = map.evaluate(p);
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(hit.depth_m, 0.01F - p.z(), 2e-6F);
    EXPECT_NEAR((hit.n_Q - Vec3f::UnitZ()).norm(), 0, 5e-3F);
    EXPECT_NEAR((hit.p_QS - (p + hit.depth_m * hit.n_Q)).norm(), 0, 1e-7F);
  }
}

TEST(RadialMap, SphereGivesRadialDepthAtAnyResolution) {
  geometry::Superquadric sphere;
  sphere.a = Vec3::Constant(0.05);
  const RadialMap map = *make_superquadric_object(sphere, 0.01).parts[0].map.radial();
  double worst_depth = 0;
  double worst_angle = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = Vec3(std::sin(1.3 * i), std::cos(2.1 * i), std::sin(0.7 * i + 1)).normalized();
    const double radius = 0.05 * (0.8 + 0.199 * (i % 50) / 50.0);
    const MapHit hit = map.evaluate((radius * d).cast<float>());
    ASSERT_TRUE(hit.hit);
    worst_depth = std::max(worst_depth, std::abs(hit.depth_m - (0.05 - radius)));
    worst_angle = std::max(worst_angle, std::acos(std::min(1.0, hit.n_Q.cast<double>().dot(d))));
  }
  EXPECT_LT(worst_depth, 0.0012 * 0.05);
  EXPECT_LT(worst_angle, 0.05);  // bilinear: the normal turns in steps of a texel
}

TEST(RadialMap, OutsideIsNoHitAndNorIsWhatIsNotANumber) {
  const RadialMap map = box_map(16, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05});
  EXPECT_FALSE(map.evaluate({0.051F, 0, 0}).hit);
  EXPECT_FALSE(map.evaluate({0.5F, 0, 0}).hit);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(map.evaluate({nan, 0, 0}).hit);
  EXPECT_FALSE(map.evaluate({0, std::numeric_limits<float>::infinity(), nan}).hit);
  EXPECT_FALSE(PartMap().evaluate({0, 0, 0}).hit);
}

TEST(RadialMap, TheVeryCentreIsAHitWithFiniteNumbers) {
  const MapHit hit = box_map(16, {0.1, 0.1, 0.1}, {0.05, 0.05, 0.05}).evaluate(Vec3f::Zero());
  EXPECT_TRUE(hit.hit);
  EXPECT_NEAR(hit.depth_m, 0.05F, 1e-3F);
  EXPECT_TRUE(hit.n_Q.allFinite());
}

TEST(RadialMap, ArgumentsThatMakeNoMapAreRefused) {
  const Vec3f one = Vec3f::Ones();
  EXPECT_TRUE(RadialMap::is_valid(16, one, one, 1e-4F, 1536));
  EXPECT_FALSE(RadialMap::is_valid(17, one, one, 1e-4F, 6 * 17 * 17));
  EXPECT_FALSE(RadialMap::is_valid(16, one, one, 1e-4F, 1535));
  EXPECT_FALSE(RadialMap::is_valid(16, one, Vec3f::Zero(), 1e-4F, 1536));
  EXPECT_FALSE(RadialMap::is_valid(16, one, one, std::numeric_limits<float>::quiet_NaN(), 1536));
}

}  // namespace
}  // namespace mechane::collision
