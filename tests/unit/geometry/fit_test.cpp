#include "server/geometry/fitting/fit.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "server/geometry/mesh_query.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::geometry {
namespace {

Mesh placed(Mesh mesh, const Pose& X) {
  for (Vec3& v : mesh.vertices)
    v = X * v;
  return mesh;
}

const Pose kSomewhere{{0.4, -1.2, 2.5}, quat_from_rotation_vector({0.7, -1.1, 0.4})};

/// The largest distance between the two surfaces, both ways, in % of the diagonal.
double surface_difference_pct(const FitResult& fit, const Mesh& truth) {
  const Mesh fitted = placed(tessellate(fit.shape, 40), fit.X_OQ);
  const MeshQuery to_truth(truth);
  const MeshQuery to_fitted(fitted);
  double worst = 0;
  for (const Vec3& v : fitted.vertices)
    worst = std::max(worst, to_truth.closest(v).distance_m);
  for (const Vec3& v : truth.vertices)
    worst = std::max(worst, to_fitted.closest(v).distance_m);
  return 100 * worst / truth.bounds().diagonal().norm();
}

struct Case {
  const char* name;
  Vec3 a;
  double e1, e2;
};

class Recovers : public ::testing::TestWithParam<Case> {};

TEST_P(Recovers, ASampledSuperquadricWherever) {
  Superquadric s;
  s.a = GetParam().a;
  s.e1 = GetParam().e1;
  s.e2 = GetParam().e2;
  const Mesh truth = placed(tessellate(s, 40), kSomewhere);
  const auto fit = fit_superquadric(truth);
  ASSERT_TRUE(fit.has_value()) << fit.error().to_string();
  EXPECT_LT(surface_difference_pct(*fit, truth), 1.5) << fit->report.start;
  EXPECT_LT(fit->report.mean_pct, 0.3);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Recovers,
                         ::testing::Values(Case{"ellipsoid", {0.1, 0.2, 0.3}, 1, 1},
                                           Case{"box", {0.3, 0.2, 0.1}, 0.2, 0.2},
                                           Case{"cylinder", {0.1, 0.1, 0.4}, 0.2, 1},
                                           Case{"disc", {0.3, 0.3, 0.05}, 0.4, 1},
                                           Case{"lens", {0.2, 0.15, 0.1}, 1.5, 0.9}),
                         [](const auto& shape) { return std::string(shape.param.name); });

TEST(Fit, TaperIsFoundAndKept) {
  Superquadric s;
  s.a = {0.05, 0.05, 0.2};
  s.e1 = 0.3;
  s.taper_x = s.taper_y = 0.4;
  const Mesh truth = placed(tessellate(s, 40), kSomewhere);
  const auto fit = fit_superquadric(truth);
  ASSERT_TRUE(fit.has_value());
  EXPECT_TRUE(fit->report.deformed);
  EXPECT_LT(surface_difference_pct(*fit, truth), 2);
}

TEST(Fit, BendIsFoundAndKept) {
  Superquadric s;
  s.a = {0.03, 0.05, 0.2};
  s.e1 = s.e2 = 0.5;
  s.bend_per_m = 4;
  s.bend_angle_rad = 0.3;
  const Mesh truth = placed(tessellate(s, 40), kSomewhere);
  const auto fit = fit_superquadric(truth);
  ASSERT_TRUE(fit.has_value());
  EXPECT_TRUE(fit->report.deformed);
  EXPECT_LT(surface_difference_pct(*fit, truth), 3);
}

TEST(Fit, BoundsEveryVertexOfAnUnlikelyPart) {
  // A wedge: no superquadric, but a part that an author may well give.
  Mesh wedge = test::box({0.2, 0.1, 0.05});
  for (Vec3& v : wedge.vertices)
    v.z() *= 1 + 4 * v.x();
  const auto fit = fit_superquadric(wedge);
  ASSERT_TRUE(fit.has_value());
  const Pose X_QO = fit->X_OQ.inverse();
  for (const Vec3& v : wedge.vertices)
    EXPECT_LE(inside_outside(fit->shape, X_QO * v), 1);
  EXPECT_TRUE(is_valid(fit->shape));
}

TEST(Fit, SameInputSameBits) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const auto once = fit_superquadric(test::cylinder(0.02, 0.1, 24));
  const auto again = fit_superquadric(test::cylinder(0.02, 0.1, 24));
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->shape.a, again->shape.a);
  EXPECT_EQ(once->X_OQ.p, again->X_OQ.p);
  EXPECT_EQ(once->report.start, again->report.start);
}

TEST(Fit, PointsThatMakeNoPartAreAnError) {
  std::vector<Vec3> plane;
  for (int i = 0; i < 100; ++i)
    plane.emplace_back(0.1 * (i % 10), 0.1 * (i / 10), 0.0);
  const auto flat = fit_superquadric(plane);
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::invalid_value);
  EXPECT_NE(flat.error().what.find("plane"), std::string::npos);
  EXPECT_FALSE(flat.error().remedy.empty());

  const std::vector<Vec3> three = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(fit_superquadric(three));
  const std::vector<Vec3> spot(50, Vec3(1, 2, 3));
  EXPECT_FALSE(fit_superquadric(spot));
  std::vector<Vec3> nan = plane;
  nan[17].x() = std::numeric_limits<double>::quiet_NaN();
  const auto bad = fit_superquadric(nan);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().code, ErrorCode::invalid_value);
  EXPECT_NE(bad.error().what.find("17"), std::string::npos);
  EXPECT_FALSE(fit_superquadric(Mesh{}));
}

}  // namespace
}  // namespace mechane::geometry
