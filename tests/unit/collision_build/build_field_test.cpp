#include "server/collision_build/build_field.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/block_lattice.hpp"
#include "server/collision_build/bounding_plane.hpp"
#include "server/collision_build/object_builder.hpp"
#include "tests/support/fields.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::collision_build {
namespace {

struct Case {
  std::string name;
  geometry::Mesh mesh;
};

std::vector<Case> cases() {
  std::vector<Case> made = {
      {"box", test::box({0.6, 0.3, 0.2})}, {"torus", test::torus(0.4, 0.15)}, {"gear", test::gear(8)}};
  for (Case& one : made) {
    for (Vec3& v : one.mesh.vertices)
      v *= 0.2;
  }
  return made;
}

/// A mesh with all that a build of its field needs, turned askew.
struct Workpiece {
  std::vector<geometry::Mesh> meshes;
  Solid solid;
  geometry::MeshQuery query;
  Pose X_OQ{Vec3(0.01, 0.02, -0.01), Quat(Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()))};
  collision::DistanceField::Grid grid;

  Workpiece(geometry::Mesh mesh, int blocks) : meshes{std::move(mesh)}, solid(meshes, 0), query(meshes[0]) {
    Eigen::AlignedBox3d box_Q;
    for (const Vec3& p_O : meshes[0].vertices)
      box_Q.extend(X_OQ.inverse() * p_O);
    grid = brick_grid({X_OQ, box_Q.center(), 0.5 * box_Q.sizes()}, blocks);
  }
  [[nodiscard]] double depth_m(const Vec3& p_O) const { return -query.signed_distance(p_O); }
  [[nodiscard]] Vec3 any_place_Q(Random& random) const {
    const collision::BoxView box = grid.box();
    Vec3 p_Q = test::any_vector(random);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      p_Q[axis] = static_cast<double>(box.center[i]) + p_Q[axis] * static_cast<double>(box.half[i]);
    }
    return p_Q;
  }
  [[nodiscard]] FieldSource source() const { return {solid, query, meshes[0], X_OQ}; }
};

constexpr BrickNeeds kNeeds{0.004, 0.0006, 0.2, 0.001};
constexpr std::size_t kEnough = 1U << 20;

TEST(BuildField, PlanesAreNeverAboveTheDistance) {
  for (const Case& one : cases()) {
    const Workpiece piece(one.mesh, 6);
    const auto field = build_field(piece.source(), piece.grid, kNeeds, {}, kEnough);
    ASSERT_TRUE(field) << one.name;
    const auto block_m = static_cast<double>(piece.grid.block_m);
    Random random(1);
    double loss = 0;
    int outside = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 p_Q = piece.any_place_Q(random);
      const Vec3 at = (p_Q - piece.grid.origin_Q.cast<double>()) / block_m;
      collision::Node block{};
      for (std::size_t k = 0; k < 3; ++k)
        block[k] = static_cast<int>(at[static_cast<Eigen::Index>(k)]);
      const auto entry = field->data().entries[collision::index_of(piece.grid.blocks, block)];
      const double bound_m = block_m * collision::DistanceField::Plane::unpacked(static_cast<std::uint32_t>(entry))
                                           .at(at - Vec3(block[0], block[1], block[2]));
      const double distance_m = -piece.depth_m(piece.X_OQ * p_Q);
      ASSERT_LE(bound_m, std::max(distance_m, 0.0)) << one.name << " " << p_Q.transpose();
      if (distance_m <= 0) continue;
      loss += distance_m - std::max(bound_m, 0.0);
      ++outside;
    }
    EXPECT_LT(loss / outside, 0.35 * block_m) << one.name << ": planes that low cull little";
  }
}

class BuildFieldOf : public ::testing::TestWithParam<int> {};  // so many blocks

/// Where surfaces are smooth, leaves span several of the finer blocks.
TEST_P(BuildFieldOf, DepthsAreRightAlsoFarInside) {
  for (const Case& one : cases()) {
    const Workpiece piece(one.mesh, GetParam());
    const auto field = build_field(piece.source(), piece.grid, kNeeds, {}, kEnough);
    ASSERT_TRUE(field) << one.name;
    EXPECT_LT(field->data().slack_m, 0.002F) << one.name;
    const auto& entries = field->data().entries;
    const auto spans = [](std::uint64_t entry) { return (entry >> (32 + collision::kFieldSpanAt)) != 0; };
    const auto large = static_cast<std::size_t>(std::count_if(entries.begin(), entries.end(), spans));
    EXPECT_EQ(large > entries.size() / 10, GetParam() > 6) << one.name << large;
    Random random(2);
    int wrong = 0;
    int missed = 0;
    int deep = 0;
    int probes = 0;
    for (int i = 0; i < 20'000; ++i) {
      const Vec3 p_Q = piece.any_place_Q(random);
      const double truth_m = piece.depth_m(piece.X_OQ * p_Q);
      const collision::MapHit hit = field->evaluate(p_Q.cast<float>());
      const double told_m = hit.hit ? static_cast<double>(hit.depth_m) : 0;
      const double may_err_m = std::max(1.5 * kNeeds.tolerance_m, 0.35 * truth_m);
      wrong += std::abs(told_m - std::max(truth_m, 0.0)) > may_err_m ? 1 : 0;
      missed += truth_m > may_err_m && !hit.hit ? 1 : 0;
      deep += truth_m > 0.02 ? 1 : 0;
      ++probes;
    }
    EXPECT_LT(wrong, probes / 1000) << one.name;
    EXPECT_LE(missed, 2) << one.name << ": at a corner, between the places that were tried; witnesses find those";
    EXPECT_GT(deep, 100) << one.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, BuildFieldOf, ::testing::Values(6, 13));

TEST(BuildField, TheSameBitsEachTimeAndNoneTooLarge) {
  const Workpiece piece(cases()[1].mesh, 5);
  const auto first = build_field(piece.source(), piece.grid, kNeeds, {}, kEnough);
  const auto second = build_field(piece.source(), piece.grid, kNeeds, {}, kEnough);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->data().entries, second->data().entries);
  EXPECT_EQ(first->data().children, second->data().children);
  EXPECT_EQ(first->data().slots, second->data().slots);
  EXPECT_TRUE(build_field(piece.source(), piece.grid, kNeeds, {}, first->bytes()));
  EXPECT_FALSE(build_field(piece.source(), piece.grid, kNeeds, {}, first->bytes() - 1));
}

TEST(BuildField, TheBuilderKeepsAMeshInOneField) {
  const std::vector<geometry::NamedMesh> nodes = {{"ring", cases()[1].mesh}};
  BuildConfig config;
  config.fields = true;
  config.max_error_share = 0.006;
  config.miss_share = 0.004;
  BuildReport report;
  const auto object = build_object(nodes, config, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  ASSERT_EQ(object->parts.size(), 1U);
  EXPECT_NE(object->parts[0].map.field(), nullptr);
  EXPECT_TRUE(report.parts[0].map.starts_with("field ")) << report.parts[0].map;
  EXPECT_TRUE(report.parts[0].met);
  EXPECT_LE(report.error.p99_m, report.budget.depth_p99_m);
  EXPECT_EQ(report.error.missed + report.error.wrong, 0U);
}

/// A plank with a peg in it, and a block 0.5 mm beside it: neither the walls at the seams nor the crack can be felt.
TEST(BuildField, PartsAreUnitedWithoutWallsAndCracksInside) {
  const std::vector<geometry::NamedMesh> nodes = {{"plank", test::box({0.1, 0.02, 0.01})},
                                                  {"peg", test::cylinder(0.008, 0.02, 24, {0, 0, 0.022})},
                                                  {"block", test::box({0.03, 0.02, 0.01}, {0.1305, 0, 0})}};
  BuildConfig config;
  config.fields = true;
  BuildReport report;
  const auto object = build_object(nodes, config, &report);
  ASSERT_TRUE(object) << object.error().to_string();
  ASSERT_EQ(object->parts.size(), 1U);
  const collision::Part& part = object->parts[0];
  ASSERT_NE(part.map.field(), nullptr);
  EXPECT_TRUE(report.parts[0].met);
  EXPECT_EQ(report.error.missed + report.error.wrong, 0U);
  const auto depth_m = [&](const Vec3& p_O) {
    const collision::MapHit hit = part.map.evaluate((part.X_OQ.inverse() * p_O).cast<float>());
    return hit.hit ? static_cast<double>(hit.depth_m) : 0;
  };
  EXPECT_GT(depth_m({0, 0, 0.006}), 0.006) << "4 mm from the peg's end and from the plank's top, 9 mm from air";
  EXPECT_NEAR(depth_m({0.10025, 0, 0.006}), 0.004, 0.0008) << "in the crack";
  EXPECT_NEAR(depth_m({0.05, 0.005, 0.008}), 0.002, 0.0008);
  EXPECT_NEAR(depth_m({0, 0, 0.039}), 0.003, 0.0008);
  EXPECT_EQ(depth_m({0.10025, 0, 0.011}), 0) << "above the crack";
  EXPECT_EQ(depth_m({0.012, 0, 0.012}), 0) << "between plank and peg";
  config.parts = Parts::as_given;
  const auto given = build_object(nodes, config);
  ASSERT_TRUE(given);
  EXPECT_EQ(given->parts.size(), nodes.size()) << "an author may want them apart";
}

}  // namespace
}  // namespace mechane::collision_build
