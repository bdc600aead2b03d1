#include "server/collision_build/object_builder.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/object_io.hpp"
#include "server/collision/samples.hpp"
#include "server/geometry/mesh_query.hpp"
#include "server/geometry/superquadric_mesh.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/open_meshes.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::collision_build {
namespace {

using geometry::NamedMesh;

/// The hit that find_contacts would report for one point, over all parts.
collision::MapHit ask(const collision::Object& object, const Vec3& p_O) {
  collision::MapHit best;
  for (const collision::Part& part : object.parts) {
    const collision::MapHit hit = part.map.evaluate((part.X_OQ.inverse() * p_O).cast<float>());
    if (hit.hit && (!best.hit || hit.m < best.m)) best = hit;
  }
  return best;
}

void expect_sound(const collision::Object& object) {
  ASSERT_EQ(object.first_group.size(), object.parts.size() + 1);
  std::size_t grouped = 0;
  for (const collision::ClusterGroup& group : object.groups) {
    ASSERT_EQ(group.first_cluster, grouped);
    grouped += group.count;
  }
  ASSERT_EQ(grouped, object.clusters.size());
  collision::for_each_sample(object, [&](const collision::Cluster& c, std::size_t lane) {
    const Vec3 p = c.sample_O(lane).cast<double>();
    EXPECT_LE((p - c.bound_O.center).norm(), c.bound_O.radius);
    EXPECT_LE((p - object.bound_O.center).norm(), object.bound_O.radius * (1 + 1e-6));
  });
}

TEST(BuildObject, ABoxIsABox) {
  const std::vector<NamedMesh> parts = {{"plank", test::box({0.2, 0.05, 0.01})}};
  BuildReport report;
  const auto object = build_object(parts, {}, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  expect_sound(*object);
  EXPECT_GT(collision::sample_count(*object), 1500U);
  ASSERT_EQ(report.parts.size(), 1U);
  EXPECT_LT(report.parts[0].error.p50_m, 2e-5);
  EXPECT_LE(report.parts[0].error.p99_m, report.budget.depth_p99_m);
  EXPECT_TRUE(report.parts[0].met);
}

class Barrel : public ::testing::TestWithParam<std::pair<int, double>> {
 protected:
  static constexpr double kInner = 0.13;
  static constexpr double kOuter = 0.15;
  static constexpr double kHalf = 0.3;
  [[nodiscard]] static Vec3 at(double radius, double angle, double z) {
    return {radius * std::cos(angle), radius * std::sin(angle), z};
  }
};

TEST_P(Barrel, HollowIsAirAndSolidIsSolidAlsoAtTheSeams) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const auto [staves, gap] = GetParam();
  const auto parts = test::barrel(staves, kInner, kOuter, kHalf, 96 / staves, gap);
  BuildConfig config;
  config.sample_spacing_m = 0.02;
  BuildReport report;
  const auto object = build_object(parts, config, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  expect_sound(*object);

  Random random(11);
  int missed = 0;
  int sideways = 0;
  double worst = 0;
  const int kProbes = 4000;
  for (int i = 0; i < kProbes; ++i) {
    const double angle = 2 * kPi * random.unit();
    const double z = 0.95 * kHalf * (2 * random.unit() - 1);
    // Air, up to a millimetre from the inner wall: the 96 facets are chords, and a chord lies inside the circle.
    EXPECT_FALSE(ask(*object, at((kInner - 0.0011) * std::sqrt(random.unit()), angle, z)).hit);
    // Wood: under the outer wall by what must not be missed, and as deep as maps are held to their budget.
    const double missable_m = config.max_error_m + 0.0001;
    const double depth = missable_m + (report.budget.probe_depth_m - missable_m) * random.unit();
    const Vec3 solid = at(kOuter - depth, angle, z);
    const collision::MapHit hit = ask(*object, solid);
    missed += hit.hit ? 0 : 1;
    if (!hit.hit) continue;
    worst = std::max(worst, std::abs(hit.depth_m - depth));
    sideways += std::abs(hit.depth_m - depth) > 0.001 ? 1 : 0;
  }
  EXPECT_EQ(missed, 0);
  // Wide staves curve too much for one map; beside a crack the exact mesh has a wall that ours has not.
  const bool exact = staves >= 16 && gap == 0;
  EXPECT_LT(sideways, exact ? kProbes / 100 : kProbes / 50) << "worst " << worst;
  const double bound_m = exact ? config.max_error_m : 0.002;
  for (const PartReport& part : report.parts) {
    EXPECT_TRUE(part.met || !exact) << part.name;
    EXPECT_LE(part.error.p99_m, bound_m) << part.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Staves, Barrel,
                         ::testing::Values(std::pair{16, 0.0}, std::pair{16, 0.0005}, std::pair{8, 0.0}),
                         [](const auto& c) {
                           return std::to_string(c.param.first) + (c.param.second > 0 ? "_with_cracks" : "_tight");
                         });

TEST(BuildObject, SeamsAreNotSampled) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const auto parts = test::barrel(16, 0.13, 0.15, 0.3, 4);
  BuildConfig config;
  config.sample_spacing_m = 0.01;
  const auto object = build_object(parts, config);
  ASSERT_TRUE(object);
  collision::for_each_sample(*object, [](const collision::Cluster& cluster, std::size_t lane) {
    const Vec3f p = cluster.sample_O(lane);
    const double radius = std::hypot(p.x(), p.y());
    const bool on_wall = radius < 0.1301 || radius > 0.1485;
    const bool on_end = std::abs(p.z()) > 0.2999F;
    EXPECT_TRUE(on_wall || on_end) << p.transpose();
  });
}

TEST(BuildObject, SameInputSameBits) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const auto once = build_object(test::crank(), {});
  const auto again = build_object(test::crank(), {});
  ASSERT_TRUE(once && again);
  ASSERT_EQ(once->clusters.size(), again->clusters.size());
  for (std::size_t i = 0; i < once->clusters.size(); ++i)
    ASSERT_EQ(once->clusters[i].samples_O.x, again->clusters[i].samples_O.x);
  for (std::size_t i = 0; i < once->parts.size(); ++i) {
    ASSERT_EQ(once->parts[i].map.name(), again->parts[i].map.name());
  }
  EXPECT_EQ(collision::write_object(*once), collision::write_object(*again));
}

TEST(BuildObject, ATurnedPlankGetsItsTightBox) {
  const Vec3 half(0.2, 0.05, 0.02);
  std::vector<NamedMesh> parts = {{"plank", test::box(half)}};
  const Quat turn = Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()));
  for (Vec3& v : parts[0].mesh.vertices)
    v = turn * v + Vec3(0.3, -0.1, 0.2);
  BuildConfig config;
  config.bounds = Bounds::boxes;
  BuildReport report;
  const auto object = build_object(parts, config, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  expect_sound(*object);
  const collision::Part& part = object->parts[0];
  EXPECT_LT((part.X_OQ.p - Vec3(0.3, -0.1, 0.2)).norm(), 1e-6);
  for (const Vec3& v : parts[0].mesh.vertices) {
    EXPECT_LE(geometry::inside_outside(part.superquadric, part.X_OQ.inverse() * v), 1 + 1e-6);
    const Vec3 corner = (part.X_OQ.inverse() * v).cwiseAbs();
    EXPECT_NEAR(corner.prod(), half.prod(), 1e-3 * half.prod());
  }
  EXPECT_LT(report.parts[0].fit.max_pct, 0.1);
  EXPECT_TRUE(report.parts[0].met);
}

TEST(BuildObject, TheCapOnSamplesWidensTheSpacing) {
  BuildConfig config;
  config.max_samples_per_part = 200;
  BuildReport report;
  const std::vector<NamedMesh> parts = {{"plank", test::box({0.4, 0.2, 0.05})}};
  const auto object = build_object(parts, config, &report);
  ASSERT_TRUE(object);
  EXPECT_LE(collision::sample_count(*object), 200U);
  EXPECT_GT(collision::sample_count(*object), 100U);
  EXPECT_GT(report.parts[0].spacing_m, config.sample_spacing_m);
}

TEST(BuildObject, AnOpenPartIsClosedOrASheet) {
  std::vector<NamedMesh> parts = {{"cup", test::box({0.05, 0.05, 0.05})}};
  parts[0].mesh.triangles.erase(parts[0].mesh.triangles.begin(), parts[0].mesh.triangles.begin() + 2);
  for (const geometry::SolidKind kind : {geometry::SolidKind::automatic, geometry::SolidKind::sheet}) {
    BuildConfig config;
    config.solid = {kind, 0.006};
    config.parts = Parts::as_given;
    BuildReport report;
    const auto object = build_object(parts, config, &report);
    ASSERT_TRUE(object) << object.error().to_string();
    expect_sound(*object);
    EXPECT_GT(report.solids[0].open_edges, 0U);
    const bool sheet = kind == geometry::SolidKind::sheet;
    EXPECT_EQ(report.solids[0].membrane_area_m2 > 0, !sheet);
    const collision::MapHit hit = ask(*object, {sheet ? 0.051 : 0.048, 0.01, 0.01});
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(hit.depth_m, 0.002, 6e-4);
    EXPECT_EQ(ask(*object, {0.01, 0.01, 0.02}).hit, !sheet);
    EXPECT_FALSE(ask(*object, {0.01, 0.01, -0.055}).hit) << "over the hole";
  }
}

TEST(BuildObject, AnOpenMeshIsOneMapAndTheSameAgain) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it asks 48,000 winding numbers");
  const std::vector<NamedMesh> parts = {{"scan", test::ball_with_holes(0.1, 4, 0.3, 1, 24)}};
  BuildReport report;
  const auto once = build_object(parts, {}, &report);
  const auto again = build_object(parts, {});
  ASSERT_TRUE(once && again);
  ASSERT_GT(report.solids[0].open_edges, 0U);
  ASSERT_EQ(once->parts.size(), 1U);
  EXPECT_EQ(once->parts[0].name, "scan") << "and no piece of it";
  EXPECT_TRUE(report.parts[0].met);
  EXPECT_EQ(collision::write_object(*once), collision::write_object(*again));
}

TEST(BuildObject, WhatEnclosesNothingIsNoSolidIfItMustBeClosed) {
  std::vector<NamedMesh> parts = {{"sail", {}}};
  parts[0].mesh.vertices = {{0, 0, 0}, {0.2, 0, 0}, {0, 0.2, 0}};
  parts[0].mesh.triangles = {{0, 1, 2}};
  BuildConfig config;
  config.solid.kind = geometry::SolidKind::closed;
  const auto none = build_object(parts, config);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error(), test::is_error(ErrorCode::invalid_value, 0, {"part 'sail'"}));
  EXPECT_TRUE(build_object(parts, {}));
}

TEST(BuildObject, ABudgetOutOfReachGetsNoWorseMapThanOneWithinReach) {
  geometry::Superquadric ball;
  ball.a = Vec3(0.05, 0.04, 0.06);
  const std::vector<NamedMesh> parts = {{"ball", geometry::tessellate(ball, 24)}};
  for (const bool bricks : {true, false}) {
    BuildConfig config;
    config.bricks = bricks;
    config.radial_maps = !bricks;
    BuildReport within, beyond;
    config.max_error_share = 0.003;
    ASSERT_TRUE(build_object(parts, config, &within));
    config.max_error_share = 1e-9;
    ASSERT_TRUE(build_object(parts, config, &beyond));
    EXPECT_TRUE(within.parts[0].met);
    EXPECT_FALSE(beyond.parts[0].met);
    EXPECT_LE(beyond.parts[0].error.p99_m, within.parts[0].error.p99_m) << (bricks ? "brick" : "radial map");
  }
}

TEST(BuildObject, BadPartsAreNamedWithARemedy) {
  using mechane::test::is_error;
  const auto error_of = [](std::vector<NamedMesh> parts, BuildConfig config = {}) {
    const auto object = build_object(parts, config);
    EXPECT_FALSE(object);
    return object ? Error{} : object.error();
  };
  const auto with = [&](const BuildConfig& config) { return error_of({{"good", test::box({1, 1, 1})}}, config); };
  EXPECT_THAT(error_of({}), is_error(ErrorCode::missing, 0, {"object: "}));
  EXPECT_THAT(error_of({{"good", test::box({1, 1, 1})}, {"empty", {}}}),
              is_error(ErrorCode::missing, 0, {"part 'empty'"}));
  std::vector<NamedMesh> nan = {{"lid", test::box({1, 1, 1})}};
  nan[0].mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(nan), is_error(ErrorCode::invalid_value, 0, {"part 'lid'", "vertex 0"}));
  EXPECT_THAT(error_of({{"sheet", test::box({1, 1, 1e-7})}}), is_error(ErrorCode::invalid_value, 0, {"part 'sheet'"}));
  BuildConfig config;
  config.map_resolution = 20;
  EXPECT_THAT(with(config), is_error(ErrorCode::invalid_value, 0, {"build settings", "map_resolution is 20"}));
  config = {};
  config.sample_spacing_m = 0;
  EXPECT_THAT(with(config), is_error(ErrorCode::invalid_value, 0, {"build settings", "sample_spacing_m"}));
  config = {};
  config.radial_maps = config.bricks = false;
  EXPECT_THAT(with(config), is_error(ErrorCode::conflict, 0, {"build settings"}));
}

geometry::Mesh small_gear() {
  geometry::Mesh mesh = test::gear();
  for (Vec3& v : mesh.vertices)
    v *= 0.2;
  return mesh;
}

TEST(BuildObject, AGearIsOneBrickThatErrsNowhereMuch) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const std::vector<NamedMesh> nodes = {{"gear", small_gear()}};
  BuildReport report;
  const auto object = build_object(nodes, {}, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  expect_sound(*object);
  ASSERT_EQ(object->parts.size(), 1U);
  ASSERT_EQ(report.parts.size(), 1U);
  EXPECT_EQ(object->parts[0].name, "gear");
  EXPECT_NE(object->parts[0].map.brick(), nullptr);
  EXPECT_TRUE(report.parts[0].met);
  EXPECT_LT(report.bytes, 60'000U);
  EXPECT_LE(report.error.p99_m, report.budget.depth_p99_m);
  EXPECT_EQ(report.error.missed + report.error.wrong, 0U);
  EXPECT_LT(report.error.max_m, 3 * report.budget.depth_p99_m) << "seams of parts erred by a third of the thing";
}

TEST(BuildObject, PartsThatTheAuthorGaveStayParts) {
  const std::vector<NamedMesh> nodes = {{"left", test::box({0.05, 0.05, 0.05}, {-0.05, 0, 0})},
                                        {"right", test::box({0.05, 0.05, 0.05}, {0.05, 0, 0})}};
  const auto object = build_object(nodes, {});
  ASSERT_TRUE(object);
  EXPECT_EQ(object->parts.size(), 2U);
}

}  // namespace
}  // namespace mechane::collision_build
