#include "server/collision/kernels.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/kernel_body.hpp"
#include "server/collision/part_map.hpp"
#include "server/collision/superquadric_object.hpp"
#include "tests/support/fields.hpp"

namespace mechane::collision {
namespace {

// Every way to run the kernels that this machine has. Sixteen lanes without AVX-512 are what its kernels do, but for three
// instructions, on any machine.
std::vector<const Kernels*> all_kernels() {
  static constexpr Kernels kSixteen = KernelBody<PortableLanes<16>>::table("sixteen");
  std::vector<const Kernels*> found = {&kSixteen};
  for (const auto set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (is_supported(set)) found.push_back(&kernels_of(set));
  }
  return found;
}

float between(Random& random, double least, double most) {
  return static_cast<float>(least + (most - least) * random.unit());
}

BlockTransform any_transform(Random& random) {
  BlockTransform X{};
  for (float& r : X.R_BA)
    r = between(random, -1, 1);
  for (float& p : X.p_BA)
    p = between(random, -0.1, 0.1);
  return X;
}

/// Most near the map, some far away, one not a number.
PointBlock any_points(Random& random) {
  PointBlock block{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double reach = i % 5 == 4 ? 10 : 0.6;
    block.x[i] = between(random, -reach, reach);
    block.y[i] = between(random, -reach, reach);
    block.z[i] = between(random, -reach, reach);
  }
  block.y[random.below(kLanes)] = std::numeric_limits<float>::quiet_NaN();
  block.z[random.below(kLanes)] = std::numeric_limits<float>::infinity();
  return block;
}

bool same_lane(const InsideBlock& a, const InsideBlock& b, std::size_t lane) {
  return a.m[lane] == b.m[lane] && a.p_Q.x[lane] == b.p_Q.x[lane] && a.p_Q.y[lane] == b.p_Q.y[lane] &&
         a.p_Q.z[lane] == b.p_Q.z[lane];
}

bool same_lane(const DepthBlock& a, const DepthBlock& b, std::size_t lane) {
  return a.depth_m[lane] == b.depth_m[lane] && a.n_Q.x[lane] == b.n_Q.x[lane] && a.n_Q.y[lane] == b.n_Q.y[lane] &&
         a.n_Q.z[lane] == b.n_Q.z[lane];
}

struct Answer {
  LaneMask inside = 0;
  InsideBlock points{};
  DepthBlock depth{};
};

void expect_same(const Answer& want, const Answer& got, const char* name) {
  ASSERT_EQ(want.inside, got.inside) << name;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    if ((want.inside >> lane & 1U) == 0) continue;
    EXPECT_TRUE(same_lane(want.points, got.points, lane)) << name << ", lane " << lane;
    EXPECT_TRUE(same_lane(want.depth, got.depth, lane)) << name << ", lane " << lane;
  }
}

/// Asks every set of kernels the same of a map; returns how many points were inside.
template <class Map, class Inside, class Depth>
std::size_t expect_all_alike(const Map& map, Inside Kernels::*inside, Depth Kernels::*depth, Random& random) {
  const BlockTransform X = any_transform(random);
  const PointBlock points = any_points(random);
  const auto ask = [&](const Kernels& kernels) {
    Answer answer;
    answer.inside = (kernels.*inside)(map, X, points.view(), answer.points);
    (kernels.*depth)(map, answer.points.p_Q, answer.inside, answer.depth);
    return answer;
  };
  const auto sets = all_kernels();
  const Answer want = ask(*sets.front());
  for (const Kernels* kernels : sets)
    expect_same(want, ask(*kernels), kernels->name);
  return static_cast<std::size_t>(__builtin_popcount(want.inside));
}

std::vector<std::uint16_t> any_texels(Random& random, int resolution) {
  std::vector<std::uint16_t> texels(static_cast<std::size_t>(6 * resolution * resolution));
  for (auto& texel : texels)
    texel = static_cast<std::uint16_t>(20'000 + random.below(20'000));
  return texels;
}

TEST(Kernels, EverySetGivesTheSameBitsForARadialMap) {
  Random random(7);
  std::size_t inside = 0;
  for (int round = 0; round < 400; ++round) {
    const int resolution = 16 << random.below(3);
    const auto texels = any_texels(random, resolution);
    RadialView map{texels.data(), resolution, 1.0F / 15'000, 0, {}, {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      map.center[i] = between(random, -0.1, 0.1);
      map.half[i] = between(random, 0.05, 1);
      map.inverse_half[i] = 1 / map.half[i];
    }
    inside += expect_all_alike(map, &Kernels::radial_inside, &Kernels::radial_depth, random);
  }
  EXPECT_GT(inside, 400U);  // else nothing was compared
}

/// Blocks of any level with any values: no distance, but all that a kernel may read.
DistanceBrick any_brick(Random& random) {
  DistanceBrick::Grid grid;
  for (int& n : grid.blocks)
    n = static_cast<int>(1 + random.below(6));
  grid.origin_Q = Vec3f::NullaryExpr([&] { return between(random, -0.4, -0.1); });
  grid.block_m = between(random, 0.05, 0.2);
  std::vector<std::uint32_t> index;
  std::vector<std::int8_t> values;
  for (std::size_t i = 0; i < grid.block_count(); ++i) {
    const auto any = [&] { return random.below(2) == 0; };
    const DistanceBrick::Entry entry{static_cast<int>(random.below(DistanceBrick::kLevels + 1)),
                                     any(),
                                     any(),
                                     any(),
                                     static_cast<int>(random.below(5)) - 3,
                                     values.size()};
    index.push_back(entry.packed());
    for (std::size_t k = 0; k < entry.count() || values.size() % DistanceBrick::kAlign != 0; ++k)
      values.push_back(static_cast<std::int8_t>(static_cast<int>(random.below(256)) - 128));
  }
  return {grid, 1e-3F, 0, std::move(index), values};
}

TEST(Kernels, EverySetGivesTheSameBitsForABrick) {
  Random random(8);
  std::size_t inside = 0;
  for (int round = 0; round < 400; ++round) {
    const DistanceBrick brick = any_brick(random);
    inside += expect_all_alike(brick.view(), &Kernels::brick_inside, &Kernels::brick_depth, random);
  }
  EXPECT_GT(inside, 200U);
}

TEST(Kernels, EverySetGivesTheSameBitsForAField) {
  Random random(11);
  std::size_t inside = 0;
  for (int round = 0; round < 400; ++round) {
    const DistanceField field = test::any_field(random);
    inside += expect_all_alike(field.view(), &Kernels::field_inside, &Kernels::field_depth, random);
  }
  EXPECT_GT(inside, 50U);
}

/// Clusters of points all over a field, from cluster to hits.
struct FieldAnswer {
  std::vector<std::uint32_t> near, point;
  std::vector<float> depth_m, n_x, n_y, n_z;
  bool operator==(const FieldAnswer&) const = default;
};

FieldAnswer ask_field(const Kernels& kernels, const FieldView& map, const BlockTransform& X_B, const PointRuns& points,
                      std::vector<std::uint32_t> clusters, std::size_t room) {
  const std::size_t count_of = clusters.size();
  clusters.resize(count_of + kLanes);
  FieldAnswer answer;
  answer.near.resize(4 * clusters.size() + kLanes);
  answer.near.resize(
      kernels.field_sift(map, X_B, points.quads, points.quad_stride, clusters.data(), count_of, answer.near.data()));
  answer.point.resize(room + kLanes);
  for (auto* values : {&answer.depth_m, &answer.n_x, &answer.n_y, &answer.n_z})
    values->resize(room + kLanes);
  const HitRuns out{answer.point.data(), answer.depth_m.data(), answer.n_x.data(),
                    answer.n_y.data(),   answer.n_z.data(),     room};
  std::vector<std::uint32_t> quads = answer.near;
  quads.resize(quads.size() + kLanes);
  const std::size_t count =
      kernels.field_hits(map, X_B, {0, 1, 0, 0, 0, 1, 1, 0, 0}, points, quads.data(), answer.near.size(), out);
  EXPECT_LE(count, room);
  answer.point.resize(count);
  for (auto* values : {&answer.depth_m, &answer.n_x, &answer.n_y, &answer.n_z})
    values->resize(count);
  return answer;
}

TEST(Kernels, EverySetFindsTheSamePointsInAField) {
  Random random(12);
  constexpr std::size_t kClusters = 60;
  std::size_t hits = 0;
  for (int round = 0; round < 300; ++round) {
    const DistanceField field = test::any_field(random);
    const FieldView map = field.view();
    BlockTransform X_B = any_transform(random);
    for (float& value : X_B.R_BA)
      value *= map.inverse_block;
    X_B.p_BA = {0.5F * static_cast<float>(map.blocks[0]), 0.5F * static_cast<float>(map.blocks[1]), 0};
    std::vector<PointBlock> points(kClusters);
    std::vector<QuadSpheres> quads(kClusters);
    for (std::size_t c = 0; c < kClusters; ++c) {
      points[c] = any_points(random);
      for (std::size_t i = 0; i < 4; ++i) {
        quads[c].x[i] = points[c].x[4 * i];
        quads[c].y[i] = points[c].y[4 * i];
        quads[c].z[i] = points[c].z[4 * i];
        quads[c].radius[i] = between(random, 0, 0.1);
      }
    }
    const PointRuns runs{points[0].x.data(), points[0].y.data(),
                         points[0].z.data(), sizeof(PointBlock) / sizeof(float),
                         quads[0].view(),    sizeof(QuadSpheres) / sizeof(float)};
    std::vector<std::uint32_t> clusters;
    for (std::uint32_t c = 0; c < kClusters && clusters.size() < kFieldBatch; ++c) {
      if (random.below(4) != 0) clusters.push_back(c);
    }
    const std::size_t room = random.below(4) == 0 ? 37 : kLanes * kFieldBatch;
    const auto sets = all_kernels();
    const FieldAnswer want = ask_field(*sets.front(), map, X_B, runs, clusters, room);
    for (const Kernels* kernels : sets)
      EXPECT_TRUE(ask_field(*kernels, map, X_B, runs, clusters, room) == want) << kernels->name;
    hits += want.point.size();
  }
  EXPECT_GT(hits, 1000U);
}

SphereBlock any_spheres(Random& random) {
  SphereBlock spheres{};
  for (std::size_t i = 0; i < kLanes; ++i) {
    spheres.x[i] = between(random, -0.3, 0.3);
    spheres.y[i] = between(random, -0.3, 0.3);
    spheres.z[i] = between(random, -0.3, 0.3);
    spheres.radius[i] = between(random, 0, 0.05);
  }
  return spheres;
}

/// Points of the sphere, 48 to each, that the map calls inside.
template <class Map>
bool holds_an_inside_point(const Map& map, const SphereBlock& spheres, std::size_t i, Random& random) {
  for (int k = 0; k < 48; ++k) {
    const Vec3f direction = Vec3f::NullaryExpr([&] { return between(random, -1, 1); }).normalized();
    const Vec3f center(spheres.x[i], spheres.y[i], spheres.z[i]);
    if (map.evaluate(center + spheres.radius[i] * between(random, 0, 1) * direction).hit) return true;
  }
  return false;
}

constexpr BlockTransform kIdentity{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {}};

TEST(Kernels, NoSphereThatHoldsAnInsidePointIsCulledAndManyOthersAre) {
  Random random(9);
  geometry::Superquadric shape;
  shape.a = Vec3(0.1, 0.06, 0.15);
  shape.e1 = 0.4;
  shape.e2 = 1.3;
  const PartMap map = make_superquadric_object(shape, 0.02).parts[0].map;
  int culled = 0;
  int kept = 0;
  for (int round = 0; round < 300; ++round) {
    const SphereBlock spheres = any_spheres(random);
    const LaneMask want =
        kernels_of(InstructionSet::portable).radial_near(map.radial()->view(), kIdentity, spheres.view(), 16);
    for (const Kernels* kernels : all_kernels())
      ASSERT_EQ(kernels->radial_near(map.radial()->view(), kIdentity, spheres.view(), 16), want) << kernels->name;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool near = (want >> i & 1U) != 0;
      const bool holds = holds_an_inside_point(map, spheres, i, random);
      EXPECT_TRUE(near || !holds);
      culled += near ? 0 : 1;
      kept += near && holds ? 1 : 0;
    }
  }
  EXPECT_GT(culled, 3000);
  EXPECT_GT(kept, 100);
}

TEST(Kernels, ABrickCullsNoSphereThatHoldsAnInsidePoint) {
  Random random(10);
  // A ball of 8 cm, by blocks of any level.
  const DistanceBrick::Grid grid{{5, 5, 5}, Vec3f::Constant(-0.1F), 0.04F};
  std::vector<std::uint8_t> levels(grid.block_count());
  for (auto& level : levels)
    level = static_cast<std::uint8_t>(random.below(DistanceBrick::kLevels));
  const DistanceBrick ball = DistanceBrick::from_distances(grid, levels, [&](const std::array<int, 3>& node) {
    return (grid.origin_Q + 0.01F * Vec3f(Eigen::Vector3i(node.data()).cast<float>())).norm() - 0.08F;
  });
  int culled = 0;
  for (int round = 0; round < 300; ++round) {
    const SphereBlock spheres = any_spheres(random);
    const LaneMask want = kernels_of(InstructionSet::portable).brick_near(ball.view(), kIdentity, spheres.view(), 16);
    for (const Kernels* kernels : all_kernels())
      ASSERT_EQ(kernels->brick_near(ball.view(), kIdentity, spheres.view(), 16), want) << kernels->name;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool near = (want >> i & 1U) != 0;
      EXPECT_TRUE(near || !holds_an_inside_point(ball, spheres, i, random));
      culled += near ? 0 : 1;
    }
  }
  EXPECT_GT(culled, 3000);
}

TEST(Kernels, TheBestSetIsOneThatThisMachineHas) {
  EXPECT_TRUE(is_supported(InstructionSet::portable));
  bool known = false;
  for (const Kernels* kernels : all_kernels())
    known = known || kernels == &best_kernels();
  EXPECT_TRUE(known) << best_kernels().name;
}

}  // namespace
}  // namespace mechane::collision
