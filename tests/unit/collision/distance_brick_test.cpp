#include "server/collision/distance_brick.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision_build/build_brick.hpp"
#include "server/geometry/mesh_query.hpp"
#include "tests/support/shapes.hpp"
#include "tests/support/solids.hpp"

namespace mechane::collision {
namespace {

using Node = std::array<int, 3>;

std::vector<std::uint8_t> any_levels(const DistanceBrick::Grid& grid, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint8_t> levels(grid.block_count());
  for (auto& level : levels)
    level = static_cast<std::uint8_t>(random.below(DistanceBrick::kLevels));
  return levels;
}

Vec3f place(const DistanceBrick::Grid& grid, const Node& node) {
  return grid.origin_Q + grid.block_m / DistanceBrick::kFinest * Vec3f(Eigen::Vector3i(node.data()).cast<float>());
}

Vec3f any_place(const BoxView& box, Random& random) {
  Vec3f p;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    p[i] = box.center[axis] + box.half[axis] * static_cast<float>(2 * random.unit() - 1);
  }
  return p;
}

DistanceBrick::Grid some_grid() {
  return {{4, 3, 5}, Vec3f(-0.2F, -0.1F, 0.3F), 0.05F};
}

TEST(DistanceBrick, WhatIsLinearIsToldToAStepAtEveryLevel) {
  const DistanceBrick::Grid grid = some_grid();
  const Vec3f n = Vec3f(0.6F, -0.48F, 0.64F);
  const auto plane = [&](const Vec3f& p) { return n.dot(p - Vec3f(-0.1F, 0, 0.4F)); };
  const auto brick = DistanceBrick::from_distances(grid, any_levels(grid, 1),
                                                   [&](const Node& node) { return plane(place(grid, node)); });
  Random random(2);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3f p = any_place(brick.box(), random);
    const MapHit hit = brick.evaluate(p);
    if (std::abs(plane(p)) > brick.step_m()) {
      ASSERT_EQ(hit.hit, plane(p) < 0) << p.transpose();
    }
    if (!hit.hit) continue;
    EXPECT_NEAR(hit.depth_m, -plane(p), 1.01F * brick.step_m());
    EXPECT_GT(hit.n_Q.dot(n), 0.998F);
    ++hits;
  }
  EXPECT_GT(hits, 500);
}

TEST(DistanceBrick, BlocksOfDifferentLevelsAgreeOnTheirFaces) {
  const DistanceBrick::Grid grid = some_grid();
  const auto depth = [](const Vec3f& p) { return 0.2F - std::abs(p.x() + 0.1F) - 0.5F * p.squaredNorm(); };
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    const auto brick = DistanceBrick::from_distances(
        grid, any_levels(grid, seed), [&](const Node& node) { return -0.3F - depth(place(grid, node)); });
    Random random(seed);
    for (int i = 0; i < 400; ++i) {
      Vec3f p = any_place(brick.box(), random);
      const auto axis = static_cast<Eigen::Index>(random.below(3));
      const int faces = grid.blocks[static_cast<std::size_t>(axis)] - 1;
      p[axis] =
          grid.origin_Q[axis] + grid.block_m * static_cast<float>(1 + random.below(static_cast<std::size_t>(faces)));
      const Vec3f aside = 1e-5F * Vec3f::Unit(axis);
      const MapHit before = brick.evaluate(p - aside);
      const MapHit after = brick.evaluate(p + aside);
      ASSERT_TRUE(before.hit && after.hit);
      EXPECT_NEAR(before.depth_m, after.depth_m, 1.01F * brick.step_m() + 1e-4F);
    }
  }
}

TEST(DistanceBrick, WhatCannotBeReadIsNotValid) {
  const DistanceBrick::Grid grid{{1, 1, 2}, Vec3f::Zero(), 0.1F};
  const std::vector<std::uint32_t> good = {DistanceBrick::Entry{0, false, false, false, -3, 0}.packed(),
                                           DistanceBrick::Entry{1, false, false, false, 7, 8}.packed()};
  EXPECT_TRUE(DistanceBrick::is_valid(grid, 1e-4F, 0, good, 35));
  EXPECT_FALSE(DistanceBrick::is_valid(grid, 1e-4F, 0, good, 34)) << "the last block's values end beyond the table";
  EXPECT_FALSE(DistanceBrick::is_valid(grid, 0, 0, good, 36));
  EXPECT_FALSE(DistanceBrick::is_valid(grid, std::numeric_limits<float>::quiet_NaN(), 0, good, 36));
  EXPECT_FALSE(DistanceBrick::is_valid(grid, 1e-4F, -1, good, 36));
  EXPECT_FALSE(DistanceBrick::is_valid({{1, 1, 3}, Vec3f::Zero(), 0.1F}, 1e-4F, 0, good, 36));
  EXPECT_FALSE(DistanceBrick::is_valid({{1, 0, 2}, Vec3f::Zero(), 0.1F}));
  EXPECT_FALSE(DistanceBrick::is_valid({{1, 1, DistanceBrick::kMaxBlocks + 1}, Vec3f::Zero(), 0.1F}));
}

TEST(DistanceBrick, AnEntryIsWhatWasPacked) {
  for (const DistanceBrick::Entry entry :
       {DistanceBrick::Entry{0, false, false, false, 0, 0},
        {2, false, true, false, -DistanceBrick::kMaxBase, 4},
        {DistanceBrick::kSheets, true, false, true, DistanceBrick::kMaxBase, (4U << 20) - 4}}) {
    const auto back = DistanceBrick::Entry::unpacked(entry.packed());
    EXPECT_EQ(back.level, entry.level);
    EXPECT_EQ(back.outer_convex, entry.outer_convex);
    EXPECT_EQ(back.inner_convex, entry.inner_convex);
    EXPECT_EQ(back.three, entry.three);
    EXPECT_EQ(back.base, entry.base);
    EXPECT_EQ(back.first, entry.first);
  }
}

/// A box of which only the edges bend: the blocks on its faces stay coarse, whatever its place.
TEST(BuildBrick, IsFineWhereTheSurfaceBendsAndNowhereElse) {
  const Vec3 half(0.15, 0.1, 0.125);
  const std::vector<geometry::Mesh> meshes = {test::box(half)};
  const collision_build::Solid solid(meshes, 0.001);
  const geometry::MeshQuery skin(meshes[0]);
  const collision_build::MapFrame frame{{}, Vec3::Zero(), half};
  const DistanceBrick::Grid grid = collision_build::brick_grid(frame, 16);
  const collision_build::BrickNeeds needs{0.004, 2e-4};
  const auto brick = collision_build::build_brick(solid, skin, {}, grid, needs, {}, 1U << 20);
  ASSERT_TRUE(brick.has_value());
  std::array<std::size_t, DistanceBrick::kLevels + 1> blocks{};
  for (const std::uint32_t word : brick->index())
    ++blocks[static_cast<std::size_t>(DistanceBrick::Entry::unpacked(word).level)];
  EXPECT_GE(blocks[DistanceBrick::kSheets], 100U) << "its twelve edges and eight corners";
  EXPECT_EQ(blocks[1] + blocks[2], 0U);
  Random random(3);
  int asked = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 p = half.cwiseProduct(Vec3(2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1));
    const double depth = skin.closest(p).distance_m;
    if (depth > needs.probe_depth_m || depth < 2e-3) continue;
    const MapHit hit = brick->evaluate(p.cast<float>());
    ASSERT_TRUE(hit.hit) << p.transpose();
    EXPECT_NEAR(hit.depth_m, depth, 2e-3) << p.transpose();  // 4.7 mm cells, cut in two by the crease from an edge
    ++asked;
  }
  EXPECT_GT(asked, 500);
  EXPECT_FALSE(collision_build::build_brick(solid, skin, {}, grid, needs, {}, brick->bytes() - 1).has_value());
}

/// Where sheets meet, a brick jumps; its slack has to make up for that.
TEST(BuildBrick, CullsNoSphereThatHoldsAnInsidePoint) {
  geometry::Mesh mesh = test::gear();
  for (Vec3& v : mesh.vertices)
    v *= 0.2;
  const std::vector<geometry::Mesh> meshes = {mesh};
  const collision_build::Solid solid(meshes, 0.001);
  const geometry::MeshQuery skin(mesh);
  const collision_build::MapFrame frame{{}, mesh.bounds().center(), 0.5 * mesh.bounds().sizes()};
  const auto brick = collision_build::build_brick(solid, skin, {}, collision_build::brick_grid(frame, 11),
                                                  {0.004, 3e-4, 0.2, 5e-4}, {}, 1U << 20);
  ASSERT_TRUE(brick.has_value());
  const Kernels& kernels = kernels_of(InstructionSet::portable);
  constexpr BlockTransform kIdentity{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {}};
  Random random(5);
  const BoxView box = brick->box();
  std::size_t culled = 0;
  std::size_t holding = 0;
  for (int round = 0; round < 2000; ++round) {
    SphereBlock spheres{};
    for (std::size_t i = 0; i < kLanes; ++i) {
      const Vec3f center =
          any_place({box.center, {1.1F * box.half[0], 1.1F * box.half[1], 1.2F * box.half[2]}}, random);
      spheres.x[i] = center.x();
      spheres.y[i] = center.y();
      spheres.z[i] = center.z();
      spheres.radius[i] = static_cast<float>(0.012 * random.unit());
    }
    const LaneMask near = kernels.brick_near(brick->view(), kIdentity, spheres.view(), kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      bool holds = false;
      for (int k = 0; k < 24 && !holds; ++k) {
        const Vec3f way = Vec3f::NullaryExpr([&] { return static_cast<float>(2 * random.unit() - 1); }).normalized();
        holds = brick->evaluate(Vec3f(spheres.x[i], spheres.y[i], spheres.z[i]) + spheres.radius[i] * way).hit;
      }
      EXPECT_TRUE(!holds || (near >> i & 1U) != 0);
      culled += (near >> i & 1U) != 0 ? 0 : 1;
      holding += holds ? 1 : 0;
    }
  }
  EXPECT_GT(culled, 8000U);
  EXPECT_GT(holding, 3000U);
}

}  // namespace
}  // namespace mechane::collision
