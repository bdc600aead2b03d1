// Which contacts of a pair are kept, and with how few samples.
#include "server/dynamics/pair_contacts.hpp"

#include <cmath>

#include <rapidcheck/gtest.h>

#include "server/collision/samples.hpp"
#include "server/dynamics/body_samples.hpp"
#include "tests/unit/dynamics/blocks.hpp"

namespace mechane::dynamics::test {
namespace {

const Vec3 kBoxHalf_m(0.05, 0.03, 0.04);

double uniform(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}

/// A box `depth_m` deep in the table's top, turned about the upright.
Pose on_table(double x, double z, double turn_rad, double depth_m) {
  return {Vec3(x, kBoxHalf_m.y() - depth_m, z), quat_from_rotation_vector({0, turn_rad, 0})};
}

RC_GTEST_PROP(PairContacts, ABoxOnATableIsHeldUpAtItsCornersAndNothingCatchesIt, ()) {
  const state::BodyDescription plate = table();
  const auto box = box_object(kBoxHalf_m);
  const double depth_m = uniform(5e-5, 1e-3);
  const Pose X_WA = on_table(uniform(-0.15, 0.15), uniform(-0.08, 0.08), uniform(0, kPi), depth_m);
  PairContacts query;
  const auto contacts = query.find(*box, X_WA, *plate.object, plate.X_WB);
  RC_ASSERT(contacts.size() == kManifoldPoints);
  Vec3 low = Vec3::Constant(1), high = Vec3::Constant(-1);
  for (const collision::PointContact& c : contacts) {
    RC_ASSERT(c.n_BA_W.y() > 0.99);
    RC_ASSERT(std::abs(c.depth_m - depth_m) < 5e-5);
    const Vec3 p_A = X_WA.inverse() * c.p_WC;
    low = low.cwiseMin(p_A);
    high = high.cwiseMax(p_A);
  }
  // The corners of a box are not samples, but the outermost samples are near.
  RC_ASSERT(high.x() - low.x() > 1.7 * kBoxHalf_m.x());
  RC_ASSERT(high.z() - low.z() > 1.7 * kBoxHalf_m.z());
}

RC_GTEST_PROP(PairContacts, KeepOneOfTheDeepest, ()) {
  const state::BodyDescription plate = table();
  const auto box = box_object(kBoxHalf_m);
  const Quat R = quat_from_rotation_vector({uniform(-0.5, 0.5), uniform(0, kPi), uniform(-0.5, 0.5)});
  const double reach = R.toRotationMatrix().row(1).transpose().cwiseAbs().dot(kBoxHalf_m);
  const Pose X_WA{Vec3(uniform(-0.15, 0.15), reach - 3e-3, uniform(-0.08, 0.08)), R};
  std::vector<collision::PointContact> all(4096);
  collision::ContactBuffer buffer(all);
  collision::find_contacts(*box, X_WA, *plate.object, plate.X_WB, buffer);
  double deepest_m = 0;
  for (const collision::PointContact& c : buffer.contacts())
    deepest_m = std::max(deepest_m, c.n_BA_W.y() > 0.5 ? c.depth_m : 0);
  RC_PRE(deepest_m > 0);
  PairContacts query;
  double kept_m = 0;
  for (const collision::PointContact& c : query.find(*box, X_WA, *plate.object, plate.X_WB))
    kept_m = std::max(kept_m, c.depth_m);
  RC_ASSERT(kept_m >= deepest_m - 1.5e-4);
}

TEST(PairContacts, ACornerBetweenFloorAndWallIsHeldByBoth) {
  // One body that is a floor and a wall: the box leans into the corner between them.
  const std::vector<geometry::NamedMesh> parts{{"floor", mechane::test::box({0.1, 0.01, 0.1}, {0, -0.01, 0})},
                                               {"wall", mechane::test::box({0.01, 0.06, 0.1}, {-0.11, 0.04, 0})}};
  const auto corner = collision_build::build_object(parts, {});
  ASSERT_TRUE(corner) << corner.error().to_string();
  const Vec3 half(0.02, 0.02, 0.02);
  const Pose X_WA{Vec3(-0.1 + half.x() - 5e-4, half.y() - 3e-4, 0.01), Quat::Identity()};
  PairContacts query;
  bool up = false, along = false;
  for (const collision::PointContact& c : query.find(*box_object(half), X_WA, *corner, {})) {
    up = up || c.n_BA_W.y() > 0.95;
    along = along || c.n_BA_W.x() > 0.95;
  }
  EXPECT_TRUE(up);
  EXPECT_TRUE(along);
}

TEST(BodySamples, AreFewerAndReachAsFar) {
  for (const Vec3& half : {kBoxHalf_m, kTableHalf_m, Vec3(0.004, 0.004, 0.05)}) {
    const auto full = box_object(half);
    const collision::Object thin = with_fewer_samples(*full);
    EXPECT_EQ(thin.parts.size(), full->parts.size());
    const auto reach = [](const collision::Object& object, const Vec3& way) {
      double most = -1;
      collision::for_each_sample(object, [&](const collision::Cluster& c, std::size_t lane) {
        most = std::max(most, way.dot(c.sample_O(lane).cast<double>()));
      });
      return most;
    };
    for (int i = 0; i < 26; ++i) {
      const Vec3 way = Vec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (way.isZero()) continue;
      EXPECT_GT(reach(thin, way.normalized()), reach(*full, way.normalized()) - 0.006) << way.transpose();
    }
    EXPECT_LE(collision::sample_count(thin), collision::sample_count(*full));
  }
  EXPECT_LT(4 * collision::sample_count(with_fewer_samples(*box_object(kBoxHalf_m))),
            collision::sample_count(*box_object(kBoxHalf_m)));
}

}  // namespace
}  // namespace mechane::dynamics::test
