#include "server/collision/distance_field.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "server/base/random.hpp"
#include "server/collision/point_query.hpp"
#include "server/collision/samples.hpp"
#include "tests/support/fields.hpp"

namespace mechane::collision {
namespace {

TEST(DistanceField, APlaneComesBackAsItWasPacked) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto any = [&](int most) {
      return static_cast<int>(random.below(static_cast<std::size_t>(2 * most + 1))) - most;
    };
    constexpr int kSlope = DistanceField::kMaxSlope;
    const DistanceField::Plane plane{any(DistanceField::kMaxValue), {any(kSlope), any(kSlope), any(kSlope)}};
    const auto back = DistanceField::Plane::unpacked(plane.packed());
    EXPECT_EQ(back.value, plane.value);
    EXPECT_EQ(back.slope, plane.slope);
  }
}

TEST(DistanceField, ALeafTellsItsCornersToAStep) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    std::array<double, 8> corners{};
    for (double& corner : corners)
      corner = 2 * random.unit() - 1.2;
    const auto leaf = DistanceField::Leaf::smooth(corners, {0.2, -0.1, 0.05});
    for (int corner = 0; corner < 8; ++corner)
      EXPECT_NEAR(leaf.at(Vec3(corner & 1, corner >> 1 & 1, corner >> 2)), corners[static_cast<std::size_t>(corner)],
                  2.1 / 127);
    // In the middle of an edge, half way between its corners and a quarter of its bubble above.
    EXPECT_NEAR(leaf.at({0.5, 0, 0}), 0.5 * (corners[0] + corners[1]) + 0.05, 2.1 / 127);
  }
}

/// One block of 1 m, and a plane that culls nothing.
DistanceField one_block(const DistanceField::Leaf& leaf) {
  DistanceField::Data data;
  data.grid = {{1, 1, 1}, Vec3f::Zero(), 1};
  const DistanceField::Plane plane{-DistanceField::kMaxValue, {}};
  data.entries = {std::uint64_t{DistanceField::leaf_word(1)} << 32 | plane.packed()};
  data.slots = {{}, leaf.first, leaf.second};
  return DistanceField(std::move(data));
}

/// What kernels read of a leaf is what the builder judged.
TEST(DistanceField, KernelsTellWhatTheLeafTells) {
  Random random(3);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const DistanceField::Leaf leaf = test::any_leaf(random);
    const DistanceField field = one_block(leaf);
    for (int k = 0; k < 20; ++k) {
      const Vec3 p(random.unit(), random.unit(), random.unit());
      const double told = leaf.at(p);
      const MapHit hit = field.evaluate(p.cast<float>());
      if (std::abs(told) > 1e-5) {
        ASSERT_EQ(hit.hit, told < 0) << told;
      }
      if (!hit.hit) continue;
      ++hits;
      EXPECT_NEAR(hit.depth_m, -told, 1e-5);
      EXPECT_NEAR(hit.n_Q.norm(), 1, 1e-5);
      // Farther out along the normal it is less deep, unless another sheet takes over there. Where the slope is small, its bend counts.
      const MapHit out = field.evaluate((p + 1e-3 * hit.n_Q.cast<double>()).cast<float>());
      if (out.hit && out.n_Q.dot(hit.n_Q) > 0.9F) {
        EXPECT_LT(out.depth_m, hit.depth_m + 1e-4F);
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(DistanceField, HalvedBlocksAreFoundDownToTheLastLevel) {
  // Each eighth of each level tells its own depth, a hundredth for its number.
  DistanceField::Data data;
  data.grid = {{1, 1, 1}, Vec3f::Zero(), 1};
  data.slots = {{}};
  const DistanceField::Plane plane{-1, {}};
  data.entries = {std::uint64_t{DistanceField::split_word(0)} << 32 | plane.packed()};
  for (int level = 1; level <= kFieldLevels; ++level) {
    for (int child = 0; child < DistanceField::kChildren; ++child) {
      if (child == 5 && level < kFieldLevels) {
        data.children.push_back(DistanceField::split_word(static_cast<std::size_t>(8 * level)));
        continue;
      }
      std::array<double, 8> corners{};
      corners.fill(-0.01 * (8 * level + child));
      data.children.push_back(DistanceField::leaf_word(data.slots.size()));
      data.slots.push_back(DistanceField::Leaf::smooth(corners, Vec3::Zero()).first);
    }
  }
  const DistanceField field(data);
  Vec3f low = Vec3f::Zero();
  float edge = 1;
  for (int level = 1; level <= kFieldLevels; ++level) {
    edge /= 2;
    for (int child = 0; child < DistanceField::kChildren; ++child) {
      if (child == 5 && level < kFieldLevels) continue;
      const Vec3f step(static_cast<float>(child & 1), static_cast<float>(child >> 1 & 1),
                       static_cast<float>(child >> 2));
      const MapHit hit = field.evaluate(low + edge * (step + Vec3f(0.3F, 0.6F, 0.9F)));
      ASSERT_TRUE(hit.hit);
      EXPECT_NEAR(hit.depth_m, 0.01 * (8 * level + child), 0.004) << level << " " << child;
    }
    low += edge * Vec3f(1, 0, 1);
  }
}

/// One leaf all over a cube of blocks tells what it tells of one block as large.
TEST(DistanceField, ALeafMaySpanSeveralBlocks) {
  Random random(7);
  int hits = 0;
  for (int span = 1; span <= DistanceField::kMaxSpan; ++span) {
    const int edge = 1 << span;
    for (int i = 0; i < 50; ++i) {
      const DistanceField::Leaf leaf = test::any_leaf(random);
      const DistanceField large = one_block(leaf);
      DistanceField::Data data = large.data();
      data.grid = {{edge, edge, edge}, Vec3f::Zero(), 1};
      data.entries.assign(data.grid.block_count(),
                          data.entries[0] | std::uint64_t{DistanceField::leaf_word(1, span)} << 32);
      const DistanceField divided(data);
      for (int k = 0; k < 20; ++k) {
        const Vec3f p = Vec3(random.unit(), random.unit(), random.unit()).cast<float>();
        const MapHit whole = large.evaluate(p);
        const MapHit hit = divided.evaluate(static_cast<float>(edge) * p);
        ASSERT_EQ(hit.hit, whole.hit);
        EXPECT_EQ(hit.depth_m, whole.depth_m);  // in blocks, which are smaller now
        EXPECT_EQ(hit.n_Q, whole.n_Q);
        hits += hit.hit ? 1 : 0;
      }
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(DistanceField, WhatLeadsAstrayIsNotValid) {
  const auto is_valid_with = [](std::uint32_t word, std::vector<std::uint32_t> children, std::size_t slots) {
    DistanceField::Data data;
    data.grid = {{1, 1, 1}, Vec3f::Zero(), 1};
    data.entries = {std::uint64_t{word} << 32};
    data.children = std::move(children);
    data.slots.resize(slots);
    return DistanceField::is_valid(data);
  };
  const std::vector<std::uint32_t> none(8);
  EXPECT_TRUE(is_valid_with(0, {}, 1));
  EXPECT_TRUE(is_valid_with(DistanceField::leaf_word(1), {}, 2));
  EXPECT_TRUE(is_valid_with(DistanceField::split_word(0), none, 1));
  EXPECT_TRUE(is_valid_with(DistanceField::leaf_word(1, DistanceField::kMaxSpan), {}, 2));
  EXPECT_FALSE(is_valid_with(DistanceField::leaf_word(1, DistanceField::kMaxSpan + 1), {}, 2));
  EXPECT_TRUE(is_valid_with(DistanceField::split_word(0), std::vector(8, DistanceField::leaf_word(1)), 2));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(0), std::vector(8, DistanceField::leaf_word(1, 1)), 2));
  EXPECT_FALSE(is_valid_with(0, {}, 0));
  EXPECT_FALSE(is_valid_with(DistanceField::leaf_word(2), {}, 2));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(0), {}, 2));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(8), none, 2));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(1), none, 2));
  std::vector<std::uint32_t> circle(8, DistanceField::split_word(0));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(0), circle, 2));
  std::vector<std::uint32_t> deep(8 * (kFieldLevels + 1));
  for (std::size_t level = 0; level < kFieldLevels; ++level)
    deep[8 * level] = DistanceField::split_word(8 * (level + 1));
  EXPECT_FALSE(is_valid_with(DistanceField::split_word(0), deep, 1));
  EXPECT_TRUE(is_valid_with(DistanceField::split_word(8), deep, 1));
}

/// What spheres leave out, in the order object, groups, clusters, quads, must change no answer: each point by itself gets the same.
class FieldQuery : public ::testing::TestWithParam<std::pair<std::size_t, bool>> {};

struct Spheres {
  std::vector<float> x, y, z, radius;
  void add(const geometry::Sphere& sphere) {
    x.push_back(static_cast<float>(sphere.center.x()));
    y.push_back(static_cast<float>(sphere.center.y()));
    z.push_back(static_cast<float>(sphere.center.z()));
    radius.push_back(static_cast<float>(1.00001 * sphere.radius + 1e-6));
  }
  /// With the room that kernels read beyond the last.
  SpheresView view() {
    for (std::vector<float>* values : {&x, &y, &z, &radius})
      values->resize(values->size() + kLanes);
    return {x.data(), y.data(), z.data(), radius.data()};
  }
};

TEST_P(FieldQuery, GivesWhatEachPointGetsByItself) {
  const auto [per_group, with_quads] = GetParam();
  constexpr std::size_t kGroups = 20;  // more than fit into a vector
  const Object object = test::object_of(test::ball_field());
  const PartMap& map = object.parts[0].map;
  Random random(4);
  std::size_t hits = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> points;
    for (std::size_t cluster = 0; cluster < kGroups * per_group; ++cluster) {
      const Vec3 middle = 0.1 * test::any_vector(random);
      for (std::size_t i = 0; i < kLanes; ++i)
        points.push_back((middle + 0.01 * test::any_vector(random)).cast<float>().cast<double>());
    }
    Spheres all;
    for (const Vec3& p : points)
      all.add({p, 0});
    const auto around = [&](std::size_t count) {
      Spheres spheres;
      for (std::size_t first = 0; first < points.size(); first += count)
        spheres.add(bounding_sphere(std::span(points).subspan(first, count)));
      return spheres;
    };
    Spheres clusters = around(kLanes);
    Spheres groups = around(kLanes * per_group);
    Spheres quads = around(4);
    const PointSet set{{all.x.data(), all.y.data(), all.z.data()},
                       clusters.view(),
                       groups.view(),
                       kGroups,
                       per_group,
                       Vec3f::Zero(),
                       1,
                       with_quads ? quads.view() : SpheresView{}};
    PointHits out(points.size());
    PlacedObject(object, {}).query(set, out);
    std::vector<float> depth_m(points.size());
    for (std::size_t i = 0; i < out.count; ++i) {
      EXPECT_EQ(depth_m[out.point[i]], 0) << "twice";
      depth_m[out.point[i]] = out.depth_m[i];
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
      const MapHit alone = map.evaluate(points[i].cast<float>());
      EXPECT_NEAR(depth_m[i], alone.hit ? alone.depth_m : 0, 1e-6) << points[i].transpose();
    }
    hits += out.count;
  }
  EXPECT_GT(hits, 1000U);
}

INSTANTIATE_TEST_SUITE_P(
    Groups, FieldQuery,
    ::testing::Values(std::pair<std::size_t, bool>{8, true}, std::pair<std::size_t, bool>{8, false},
                      std::pair<std::size_t, bool>{3, true}, std::pair<std::size_t, bool>{16, true}),
    [](const auto& c) { return std::to_string(c.param.first) + (c.param.second ? "_with_quads" : ""); });

TEST(FieldQuery, WritesNoMoreThanThereIsRoomFor) {
  const Object object = test::object_of(test::ball_field());
  std::vector<float> zeros(kLanes * kLanes);  // all in the middle of the ball
  const SpheresView spheres{zeros.data(), zeros.data(), zeros.data(), zeros.data()};
  const PointSet set{{zeros.data(), zeros.data(), zeros.data()}, spheres, spheres, 1, 8, Vec3f::Zero(), 1, spheres};
  PointHits out(21);
  PlacedObject(object, {}).query(set, out);
  EXPECT_EQ(out.count, 21U);
  EXPECT_EQ(out.room(), 0U);
}

/// Pieces that move by themselves, and a set of all their points.
class RigidGroups {
 public:
  static constexpr std::size_t kCount = 18;  // more than fit into a vector
  static constexpr std::size_t kEach = 4;    // clusters
  static constexpr std::size_t kPoints = kCount * kEach * kLanes;

  explicit RigidGroups(Random& random) {
    for (auto& group : points_G_)
      for (Vec3& p : group)
        p = 0.02 * test::any_vector(random);
    for (Pose& X : X_WG)
      X = {0.1 * test::any_vector(random), turned(3, random)};
  }

  static Quat turned(double most_rad, Random& random) {
    return Quat(Eigen::AngleAxisd(most_rad * random.unit(), test::any_vector(random).normalized()));
  }

  /// Valid until the next call.
  PointSet set() {
    all_ = clusters_ = groups_ = quads_ = {};
    for (std::size_t g = 0; g < kCount; ++g) {
      for (const Vec3& p_G : points_G_[g])
        all_.add({X_WG[g] * p_G, 0});
      add_spheres(g, kEach * kLanes, groups_);
      add_spheres(g, kLanes, clusters_);
      add_spheres(g, 4, quads_);
      const Eigen::Matrix3f R = X_WG[g].R.toRotationMatrix().cast<float>();
      for (std::size_t i = 0; i < R_.size(); ++i)
        R_[i][g] = R(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3));
    }
    PointSet set{{all_.x.data(), all_.y.data(), all_.z.data()},
                 clusters_.view(),
                 groups_.view(),
                 kCount,
                 kEach,
                 Vec3f::Zero(),
                 1,
                 quads_.view()};
    for (std::size_t i = 0; i < R_.size(); ++i)
      set.rotations[i] = R_[i].data();
    return set;
  }

  std::array<Pose, kCount> X_WG;

 private:
  /// Around each `count` points, as they lie in the group.
  void add_spheres(std::size_t g, std::size_t count, Spheres& to) const {
    for (std::size_t first = 0; first < points_G_[g].size(); first += count) {
      const geometry::Sphere sphere = bounding_sphere(std::span(points_G_[g]).subspan(first, count));
      to.add({X_WG[g] * sphere.center, sphere.radius});
    }
  }

  std::array<std::array<Vec3, kEach * kLanes>, kCount> points_G_;
  Spheres all_, clusters_, groups_, quads_;
  std::array<std::array<float, kCount + kLanes>, 9> R_{};
};

void expect_same_bits(const PointHits& l, const PointHits& r) {
  ASSERT_EQ(l.count, r.count);
  const auto same = [&](const auto& a, const auto& b) { return std::equal(a.begin(), a.begin() + l.count, b.begin()); };
  EXPECT_TRUE(same(l.point, r.point) && same(l.depth_m, r.depth_m));
  EXPECT_TRUE(same(l.n_x, r.n_x) && same(l.n_y, r.n_y) && same(l.n_z, r.n_z));
}

/// Slow ticks and fast ones, some groups at rest and some that turn alone, and an object that moves now and then.
TEST(FieldQuery, NearListsChangeNoBit) {
  const Object object = test::object_of(test::ball_field());
  Random random(6);
  for (const InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_supported(set)) continue;
    RigidGroups groups(random);
    NearList near(RigidGroups::kPoints, RigidGroups::kCount);
    Pose X_WO;
    std::size_t hits = 0;
    constexpr std::size_t kTicks = 300;
    for (std::size_t tick = 0; tick < kTicks; ++tick) {
      const double way_m = tick % 50 == 0 ? 0.01 : 0.0001;
      for (Pose& X_WG : groups.X_WG) {
        if (random.below(3) == 0) X_WG.p += way_m * test::any_vector(random);
        if (random.below(3) == 0) X_WG.R = RigidGroups::turned(way_m / 0.02, random) * X_WG.R;
      }
      if (tick % 70 == 69) X_WO = Pose{0.003 * test::any_vector(random), RigidGroups::turned(0.1, random)};
      const PlacedObject placed(object, X_WO);
      const PointSet points = groups.set();
      PointHits with(RigidGroups::kPoints);
      PointHits without(RigidGroups::kPoints);
      placed.query(points, near, with, kernels_of(set));
      placed.query(points, without, kernels_of(set));
      expect_same_bits(with, without);
      hits += with.count;
    }
    EXPECT_GT(hits, 10 * kTicks);
    EXPECT_GT(near.times_made(), 9U);  // after each fast tick, and each move of the object
    EXPECT_LT(near.times_made(), kTicks / 2);
  }
}

/// As samples against a field, and a field's samples against another object.
TEST(FieldQuery, FindContactsGivesTheSamplesThatAreInside) {
  const Object ball = test::object_of(test::ball_field());
  Object cloud;
  std::vector<Vec3> points;
  Random random(5);
  for (int i = 0; i < 5000; ++i)
    points.push_back(0.12 * test::any_vector(random));
  cloud.parts.resize(1);
  cloud.parts[0].bound_O = bounding_sphere(points);
  append_samples(cloud, 0, std::move(points));
  close_clusters(cloud);
  const Pose X_WB{Vec3(0.3, -0.2, 0.1), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  const Pose X_WC = X_WB * Pose{Vec3(0.05, 0, 0), Quat(Eigen::AngleAxisd(-0.4, Vec3::UnitY()))};
  std::size_t expected = 0;
  for_each_sample(cloud, [&](const Cluster& cluster, std::size_t lane) {
    const Vec3 p_B = X_WB.inverse() * X_WC * cluster.sample_O(lane).cast<double>();
    expected += ball.parts[0].map.evaluate(p_B.cast<float>()).hit ? 1 : 0;
  });
  std::vector<PointContact> storage(6000);
  ContactBuffer found(storage);
  find_contacts(cloud, X_WC, ball, X_WB, found);
  ASSERT_GT(expected, 300U);
  EXPECT_NEAR(static_cast<double>(found.contacts().size()), static_cast<double>(expected), 2);  // on the very surface
  for (const PointContact& contact : found.contacts()) {
    if (contact.depth_m > 0.5 * test::kBall_m) continue;  // around the middle no direction leads out first
    const Vec3 p_B = X_WB.inverse() * contact.p_WC;
    EXPECT_NEAR(p_B.norm(), test::kBall_m, 0.001);
    EXPECT_GT(X_WB.rotate(p_B.normalized()).dot(contact.n_BA_W), 0.99);
  }
}

}  // namespace
}  // namespace mechane::collision
