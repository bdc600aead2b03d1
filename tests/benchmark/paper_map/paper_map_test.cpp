#include "tests/benchmark/paper_map/paper_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "server/geometry/superquadric_mesh.hpp"
#include "server/geometry/surface_samples.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/superquadric_draw.hpp"

namespace mechane::benchmark {
namespace {

constexpr PaperSearch kAlongNormal{PaperWindow::corrected, PaperDepth::along_normal};

geometry::Superquadric ellipsoid(const Vec3& axes, double e1 = 1, double e2 = 1) {
  geometry::Superquadric shape;
  shape.a = axes;
  shape.e1 = e1;
  shape.e2 = e2;
  return shape;
}

/// The superquadric as its own object: D is 0 everywhere.
PaperMap bare_map(const geometry::Superquadric& shape, const PaperGrid& grid = {}) {
  const std::vector<float> zeros(static_cast<std::size_t>(grid.eta) * static_cast<std::size_t>(grid.omega), 0.0F);
  return {shape, grid, zeros};
}

struct PaperProbe {
  Vec3 p_Q = Vec3::Zero();
  double depth_m = 0;  ///< exact
};

/// Points that lie up to `deepest_m` under the surface of a closed mesh.
std::vector<PaperProbe> probes_under(const geometry::Mesh& mesh, double deepest_m, std::size_t count) {
  const geometry::MeshQuery query(mesh);
  Random random(5);
  std::vector<PaperProbe> probes;
  for (const auto& sample : geometry::sample_by_area(mesh, count, 3)) {
    const Vec3 p = sample.p - test::between(random, 0.05, 1) * deepest_m * query.triangle_normal(sample.triangle);
    const double depth = -query.signed_distance(p);
    if (depth > 0) probes.push_back({p, depth});
  }
  return probes;
}

/// The error of the depth at a share of the probes, metres; what is missed counts with all its depth.
double error_at(double share, const PaperMap& map, std::span<const PaperProbe> probes, const PaperSearch& how) {
  std::vector<double> errors;
  for (const PaperProbe& probe : probes) {
    const collision::MapHit hit = map.search(probe.p_Q.cast<float>(), how).hit;
    errors.push_back(std::abs((hit.hit ? static_cast<double>(hit.depth_m) : 0.0) - probe.depth_m));
  }
  std::sort(errors.begin(), errors.end());
  return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
}

RC_GTEST_PROP(PaperMap, EverySearchTakesEightEvaluationsALevelAndOne, ()) {
  const geometry::Superquadric shape = test::draw_superquadric(*rc::gen::arbitrary<std::uint64_t>()).shape;
  // Levels by (12): log2(max(eta / 16, omega / 32)), cut off.
  const auto& [grid, levels] = *rc::gen::elementOf(std::vector<std::pair<PaperGrid, int>>{
      {{16, 32}, 0}, {{32, 64}, 1}, {{50, 100}, 1}, {{100, 200}, 2}, {{64, 256}, 3}, {{128, 256}, 3}, {{128, 32}, 3}});
  const PaperMap map = bare_map(shape, grid);
  RC_ASSERT(map.levels() == levels);
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  for (int i = 0; i < 50; ++i) {
    // Any point of the superquadric, near its poles and seams too.
    const Vec3 surface =
        geometry::surface_point(shape, {test::between(random, -kPi / 2, kPi / 2), test::between(random, -kPi, kPi)});
    const Vec3f p = (test::between(random, 0.5, 1.3) * surface).cast<float>();
    const double F = geometry::inside_outside(shape, p.cast<double>());
    for (const PaperWindow window : {PaperWindow::corrected, PaperWindow::printed}) {
      const PaperAnswer answer = map.search(p, {window, PaperDepth::distance});
      RC_ASSERT(answer.evaluations == (answer.inside ? 8 * levels + 1 : 0));
      if (std::abs(F - 1) > 1e-2) RC_ASSERT(answer.inside == (F < 1));
    }
  }
}

RC_GTEST_PROP(PaperMap, ItsPlacesAndNormalsAreTheSuperquadrics, ()) {
  const geometry::Superquadric shape = test::draw_superquadric(*rc::gen::arbitrary<std::uint64_t>()).shape;
  const PaperMap map = bare_map(shape);
  const auto size = static_cast<float>(shape.a.maxCoeff());
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  for (int i = 0; i < 50; ++i) {
    const int eta = static_cast<int>(random.below(100));
    const int omega = static_cast<int>(random.below(200));
    const Vec3 expected = geometry::surface_point(shape, PaperMap::angles(map.grid(), eta, omega));
    RC_ASSERT((*map.surface_Q(eta, omega) - expected.cast<float>()).norm() < 2e-5F * size);
    const PaperAnswer answer = map.search((0.97 * expected).cast<float>());
    if (!answer.hit.hit) continue;  // bent far enough, that point is outside
    const Vec3 n = geometry::surface_normal(shape, PaperMap::angles(map.grid(), answer.eta, answer.omega));
    RC_ASSERT((answer.hit.n_Q - n.cast<float>()).norm() < 2e-3F);
  }
}

TEST(PaperMap, OnASphereTheDepthErrsByTheGridAlone) {
  const double radius = 0.05;
  const PaperMap map = bare_map(ellipsoid(Vec3::Constant(radius)));
  // The nearest place lies aside by half a cell each way at most: P_M is off by `aside`, the depth by what Pythagoras makes of it.
  const double aside = radius * std::hypot(0.5 * kPi / 99, kPi / 200);
  Random random(11);
  for (int i = 0; i < 5000; ++i) {
    const double depth = test::between(random, 0.01, 0.2) * radius;
    const Vec3 p = (radius - depth) * test::gaussian_vector(random).normalized();
    const collision::MapHit hit = map.search(p.cast<float>()).hit;
    ASSERT_TRUE(hit.hit);
    EXPECT_GE(hit.depth_m, depth - 1e-7);
    EXPECT_LE(hit.depth_m, std::hypot(depth, aside) + 1e-6);
    EXPECT_NEAR(map.search(p.cast<float>(), kAlongNormal).hit.depth_m, depth, 0.5 * aside * aside / radius + 1e-6);
  }
}

TEST(PaperMap, OnRoundedSuperquadricsTheDepthIsTheDistanceNearTheSurface) {
  geometry::Superquadric tapered = ellipsoid({0.05, 0.05, 0.08});
  tapered.taper_x = 0.4;
  geometry::Superquadric bent = ellipsoid({0.03, 0.03, 0.08}, 0.8, 0.8);
  bent.taper_x = 0.3;
  bent.bend_per_m = 6;
  bent.bend_angle_rad = 0.7;
  for (const geometry::Superquadric& shape :
       {ellipsoid({0.05, 0.04, 0.06}, 0.8, 0.8), ellipsoid({0.05, 0.05, 0.05}, 1.4, 1.4), ellipsoid({0.04, 0.05, 0.08}),
        tapered, bent}) {
    const geometry::Mesh mesh = geometry::tessellate(shape, 60);
    const double diagonal = mesh.bounds().diagonal().norm();
    const PaperMap map = bare_map(shape);
    const auto probes = probes_under(mesh, 0.02 * diagonal, 3000);
    EXPECT_LT(error_at(0.50, map, probes, {}), 0.001 * diagonal);
    EXPECT_LT(error_at(0.99, map, probes, {}), 0.010 * diagonal);
    EXPECT_LT(error_at(0.99, map, probes, kAlongNormal), 0.0005 * diagonal);
  }
}

TEST(PaperMap, SearchingOnBothSidesIsBetterThanThePrintedSideWhereAxesDiffer) {
  geometry::Superquadric bent = ellipsoid({0.03, 0.03, 0.08}, 0.8, 0.8);
  bent.bend_per_m = 6;
  const auto probes = probes_under(geometry::tessellate(bent, 60), 0.006, 3000);
  const PaperMap map = bare_map(bent);
  const PaperSearch printed{PaperWindow::printed, PaperDepth::distance};
  EXPECT_LT(error_at(0.99, map, probes, {}), 0.8 * error_at(0.99, map, probes, printed));
}

/// The paper's Figure 4: two spheres in a superquadric that bounds them.
TEST(PaperMap, OnTheTwoSpheresOfFigure4TheDepthIsTheMeshesWithinAPerCentAndAHalf) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const geometry::Mesh mesh = test::peanut();
  const geometry::MeshQuery query(mesh);
  const PaperMap map = cast_paper_map({query}, ellipsoid({0.45, 0.45, 0.8}), {});
  const double diagonal = mesh.bounds().diagonal().norm();
  const auto probes = probes_under(mesh, 0.02, 3000);
  EXPECT_LT(error_at(0.50, map, probes, {}), 0.002 * diagonal);
  EXPECT_LT(error_at(0.99, map, probes, {}), 0.015 * diagonal);
  // Outside the mesh, but inside the superquadric, points move freely.
  std::size_t outside = 0;
  std::size_t touched = 0;
  for (const auto& sample : geometry::sample_by_area(mesh, 3000, 9)) {
    const Vec3 p = sample.p + 0.02 * query.triangle_normal(sample.triangle);
    const PaperAnswer answer = map.search(p.cast<float>());
    if (!answer.inside || query.signed_distance(p) < 0.01) continue;
    ++outside;
    touched += answer.hit.hit ? 1 : 0;
  }
  EXPECT_GT(outside, 1000U);
  EXPECT_LE(50 * touched, outside);
}

/// Why the paper's map is no more than a reference: (5) in even steps of eta jumps over most of a face where an exponent is small, so
/// that the place found lies far aside.
TEST(PaperMap, SmallExponentsLeaveGapsInTheGridAndTheDepthErrsByThem) {
  const auto probes = [](double e) {
    return probes_under(geometry::tessellate(ellipsoid({0.05, 0.05, 0.05}, e, e), 60), 0.003, 3000);
  };
  const double round = error_at(0.99, bare_map(ellipsoid({0.05, 0.05, 0.05}, 0.9, 0.9)), probes(0.9), {});
  const double boxy = error_at(0.99, bare_map(ellipsoid({0.05, 0.05, 0.05}, 0.3, 0.3)), probes(0.3), {});
  EXPECT_LT(round, 0.001);
  EXPECT_GT(boxy, 0.005);
}

TEST(PaperMap, WhatNoRayMeetsIsNoHitAndTouchesNothing) {
  geometry::Mesh ball = test::ball(0.02);
  for (Vec3& v : ball.vertices)
    v.z() += 0.07;
  const geometry::MeshQuery query(ball);
  const PaperMap map = cast_paper_map({query}, ellipsoid({0.03, 0.03, 0.1}), {});
  EXPECT_FALSE(map.distance_m(20, 50).has_value());
  EXPECT_FALSE(map.surface_Q(20, 50).has_value());
  EXPECT_NEAR(map.distance_m(99, 0).value_or(-1), 0.01F, 1e-4F);
  for (const float z : {-0.09F, -0.05F, 0.0F}) {
    const PaperAnswer answer = map.search({0.005F, 0.003F, z});
    EXPECT_TRUE(answer.inside);
    EXPECT_FALSE(answer.hit.hit);
  }
  EXPECT_TRUE(map.search({0.003F, 0.002F, 0.08F}).hit.hit);
}

TEST(PaperMap, APlaceInANeighboursSolidIsCoveredAsDeepAsTheSolidGoesOn) {
  geometry::Mesh both = test::ball(0.05);
  geometry::Mesh neighbour = test::ball(0.05);
  for (Vec3& v : neighbour.vertices)
    v.z() += 0.06;
  both.append(neighbour);
  const geometry::MeshQuery query(both);
  const PaperMap map = cast_paper_map({query}, ellipsoid(Vec3::Constant(0.05)), {});
  EXPECT_NEAR(map.distance_m(99, 0).value_or(0), -0.06F, 1e-4F);
  EXPECT_GE(map.distance_m(0, 0).value_or(-1), 0);
  const collision::MapHit hit = map.search({0.0F, 0.0F, 0.045F}).hit;
  ASSERT_TRUE(hit.hit);
  EXPECT_NEAR(hit.depth_m, 0.065F, 1e-3F);
}

TEST(PaperMap, OutsideAndWhatIsNotANumberIsNoHit) {
  const PaperMap map = bare_map(ellipsoid({0.05, 0.04, 0.06}, 0.3, 1.7));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Vec3f& p : {Vec3f(0.051F, 0, 0), Vec3f(0.03F, 0.03F, 0), Vec3f(0, 0, -1e30F), Vec3f(nan, 0, 0),
                         Vec3f(0, infinity, nan), Vec3f(0, 0, -infinity)}) {
    const PaperAnswer answer = map.search(p);
    EXPECT_FALSE(answer.inside);
    EXPECT_FALSE(answer.hit.hit);
    EXPECT_EQ(answer.evaluations, 0);
  }
  const collision::MapHit centre = map.evaluate(Vec3f::Zero());
  EXPECT_TRUE(centre.hit);
  EXPECT_TRUE(centre.n_Q.allFinite());
}

/// How much the normal turns from cell to cell along omega, of the surface as the map has it: root mean square, radians. On facets the
/// turns gather at the edges.
double roughness(const PaperMap& map) {
  const auto normal = [&](int eta, int omega) {
    const Vec3f across = *map.surface_Q(eta, (omega + 1) % 200) - *map.surface_Q(eta, omega);
    const Vec3f up = *map.surface_Q(eta + 1, omega) - *map.surface_Q(eta, omega);
    return Vec3f(across.cross(up).normalized());
  };
  double sum = 0;
  for (int eta = 20; eta < 80; ++eta) {
    for (int omega = 0; omega < 200; ++omega) {
      const float cosine = normal(eta, omega).dot(normal(eta, (omega + 1) % 200));
      sum += std::pow(std::acos(std::min(1.0F, cosine)), 2) / (60 * 200);
    }
  }
  return std::sqrt(sum);
}

/// How much the force k S n (15, 18) of a point that sweeps around within a sphere's map changes its slope from place to place: root mean
/// square of its second difference, k = 1.
double force_jumps(const PaperMap& map, double radius_m) {
  const auto force = [&](int eta, int omega) {
    const Vec3 way = geometry::surface_normal(map.shape(), PaperMap::angles(map.grid(), eta, omega));
    const collision::MapHit hit = map.evaluate((radius_m * way).cast<float>());
    return Vec3f(hit.hit ? Vec3f(hit.depth_m * hit.n_Q) : Vec3f::Zero());
  };
  double sum = 0;
  for (int eta = 20; eta < 80; ++eta)
    for (int omega = 1; omega < 199; ++omega)
      sum += static_cast<double>((force(eta, omega + 1) - 2 * force(eta, omega) + force(eta, omega - 1)).squaredNorm());
  return std::sqrt(sum / (60 * 198));
}

TEST(PaperMap, SmoothingLowersTheRoughnessOfNormalAndForceAndKeepsTheMeanDepth) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const geometry::Mesh mesh = test::bumpy_ball();
  const geometry::MeshQuery query(mesh);
  const PaperMap rough = cast_paper_map({query}, ellipsoid(Vec3::Constant(0.58)), {});
  const PaperMap smooth = rough.smoothed(6);
  EXPECT_LT(roughness(smooth), 0.7 * roughness(rough));
  EXPECT_LT(force_jumps(smooth, 0.42), 0.9 * force_jumps(rough, 0.42));
  double before = 0;
  double after = 0;
  for (int i = 0; i < 20000; ++i) {
    before += static_cast<double>(rough.distance_m(i / 200, i % 200).value_or(0));
    after += static_cast<double>(smooth.distance_m(i / 200, i % 200).value_or(0));
  }
  EXPECT_NEAR(after, before, 0.005 * before);
}

TEST(PaperMap, SmoothingLeavesARimWhereItIs) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  std::vector<float> distances(20000, 0.01F);
  for (std::size_t i = 10000; i < 20000; ++i)
    distances[i] = i % 200 < 100 ? std::numeric_limits<float>::quiet_NaN() : -0.02F;
  const PaperMap smooth = PaperMap(ellipsoid(Vec3::Constant(0.05)), {}, distances).smoothed(3);
  EXPECT_FALSE(smooth.distance_m(50, 10).has_value());
  EXPECT_NEAR(smooth.distance_m(50, 150).value_or(0), -0.02F, 1e-6F);
  EXPECT_NEAR(smooth.distance_m(49, 10).value_or(0), 0.01F, 1e-6F);
}

TEST(PaperMap, ASearchAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  const PaperMap map = bare_map(ellipsoid({0.05, 0.04, 0.06}, 0.8, 0.8));
  const test::AllocationGuard guard;
  EXPECT_TRUE(map.search({0.02F, 0.01F, 0.01F}).hit.hit);
  EXPECT_EQ(guard.allocations(), 0U);
}

TEST(PaperMap, ArgumentsThatMakeNoMapAreRefused) {
  const std::vector<float> zeros(20000, 0.0F);
  const geometry::Superquadric shape = ellipsoid(Vec3::Ones());
  EXPECT_TRUE(PaperMap::is_valid(shape, {100, 200}, zeros));
  EXPECT_FALSE(PaperMap::is_valid(shape, {100, 198}, zeros));
  EXPECT_FALSE(PaperMap::is_valid(shape, {200, 48}, std::vector<float>(200 * 48, 0.0F)));
  EXPECT_FALSE(PaperMap::is_valid(shape, {100, 201}, std::vector<float>(100 * 201, 0.0F)));
  EXPECT_FALSE(PaperMap::is_valid(shape, {20, 1000}, zeros));
  EXPECT_FALSE(PaperMap::is_valid(ellipsoid({1, -1, 1}), {100, 200}, zeros));
  EXPECT_FALSE(
      PaperMap::is_valid(shape, {100, 200}, std::vector<float>(20000, std::numeric_limits<float>::infinity())));
}

}  // namespace
}  // namespace mechane::benchmark
