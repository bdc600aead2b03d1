#include "server/hand/held_path.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/property_draw.hpp"

namespace mechane::hand {
namespace {

using namespace std::chrono_literals;

/// A crank's handle about W's z axis, held with its place at the hand's reference point.
HeldPath circle() {
  return {.kind = HeldPath::Kind::circle,
          .axis_W = Vec3::UnitZ(),
          .radius_m = 0.2,
          .stiffness_n_per_m = 600,
          .limit_n = 100};
}

Pose hand_at(const Vec3& p_WH) {
  return {p_WH, Quat::Identity()};
}

Vec3 force_at(const HeldPath& path, const Vec3& p_WH, double along_share = 1) {
  return held_path_force(path, hand_at(p_WH), {}, 0ms, along_share);
}

RC_GTEST_PROP(HeldPath, PullsBackToTheNearestPlaceOfACircleAndPushesAlongIt, ()) {
  HeldPath path = circle();
  path.along_n = *test::between(-3, 3);
  const double angle = *test::between(0, 2 * kPi), outwards_m = *test::between(-0.01, 0.01),
               upwards_m = *test::between(-0.01, 0.01);
  const Vec3 out(std::cos(angle), std::sin(angle), 0), along(-std::sin(angle), std::cos(angle), 0);
  const Vec3 force = force_at(path, (0.2 + outwards_m) * out + upwards_m * Vec3::UnitZ(), 0.5);
  RC_ASSERT(std::abs(force.dot(out) + 600 * outwards_m) < 1e-9);
  RC_ASSERT(std::abs(force.z() + 600 * upwards_m) < 1e-9);
  RC_ASSERT(std::abs(force.dot(along) - 0.5 * path.along_n) < 1e-9);
}

RC_GTEST_PROP(HeldPath, OfALineIsTheSameEverywhereAlongIt, ()) {
  HeldPath path = circle();
  path.kind = HeldPath::Kind::line;
  path.along_n = 1;
  const Vec3 off(*test::between(-0.01, 0.01), *test::between(-0.01, 0.01), 0);
  const Vec3 force = force_at(path, off + *test::between(-1, 1) * Vec3::UnitZ());
  RC_ASSERT((force + 600 * off - Vec3::UnitZ()).norm() < 1e-9);
}

RC_GTEST_PROP(HeldPath, IsFollowedByThePlaceThatTheHandHoldsHoweverItTurns, ()) {
  HeldPath path = circle();
  path.p_HG = Vec3(*test::between(-0.1, 0.1), *test::between(-0.1, 0.1), *test::between(-0.1, 0.1));
  const Pose X_WH{Vec3(*test::between(-0.3, 0.3), *test::between(-0.3, 0.3), 0),
                  quat_from_rotation_vector(Vec3(*test::between(-3, 3), *test::between(-3, 3), *test::between(-3, 3)))};
  const Vec3 expected = force_at(circle(), X_WH * path.p_HG);
  RC_ASSERT((held_path_force(path, X_WH, {}, 0ms, 1) - expected).norm() < 1e-9);
}

TEST(HeldPath, DampsOnlyAcrossThePath) {
  HeldPath path = circle();
  path.damping_ns_per_m = 5;
  const Twist moving{Vec3(0.1, 0.3, -0.2), Vec3::Zero()};  // at angle 0: outwards, along, down
  const Vec3 force = held_path_force(path, hand_at({0.2, 0, 0}), moving, 0ms, 1);
  EXPECT_LT((force - Vec3(-0.5, 0, 1)).norm(), 1e-9);
}

TEST(HeldPath, PullsNoHarderAcrossThanTheGripBears) {
  HeldPath path = circle();
  path.limit_n = 2;
  path.along_n = 3;
  EXPECT_LT((force_at(path, {0.25, 0, 0}) - Vec3(-2, 3, 0)).norm(), 1e-9);
}

TEST(HeldPath, FadesOutAfterItsValidity) {
  const HeldPath path = circle();
  const auto at = [&](Duration age) { return held_path_force(path, hand_at({0.201, 0, 0}), {}, age, 1).norm(); };
  EXPECT_NEAR(at(path.validity), 0.6, 1e-9);
  EXPECT_NEAR(at(path.validity + kFadeTime / 2), 0.3, 1e-9);
  EXPECT_EQ(at(path.validity + kFadeTime), 0);
}

TEST(HeldPath, IsNoForceWhereThereIsNone) {
  HeldPath path = circle();
  path.kind = HeldPath::Kind::none;
  EXPECT_EQ(force_at(path, {0.3, 0, 0}), Vec3::Zero());
}

TEST(HeldPath, LetsAHandThroughItsAxisWithoutAJump) {
  HeldPath path = circle();
  path.along_n = 2;
  EXPECT_LT((force_at(path, {0, 0, 0.01}) - Vec3(0, 0, -6)).norm(), 1e-9) << "the way along the axis is the same";
  Vec3 before = force_at(path, {-0.05, 0, 0});
  for (double x = -0.05; x < 0.05; x += 1e-4) {
    const Vec3 force = force_at(path, {x, 0, 0});
    EXPECT_LT((force - before).norm(), 0.2) << x;
    before = force;
  }
}

/// On a closed way a spring gives back what it took.
RC_GTEST_PROP(HeldPath, GivesAHandNoEnergy, ()) {
  const HeldPath path = circle();
  const Vec3 middle(*test::between(0.1, 0.3), *test::between(-0.1, 0.1), *test::between(-0.05, 0.05));
  const double size_m = *test::between(0.001, 0.05);
  const auto place = [&](int i) {
    const double angle = 2 * kPi * i / 2000;
    return Vec3(middle + size_m * Vec3(std::cos(angle), std::sin(angle), std::sin(2 * angle)));
  };
  double work_j = 0;
  for (int i = 0; i < 2000; ++i)
    work_j += force_at(path, 0.5 * (place(i) + place(i + 1))).dot(place(i + 1) - place(i));
  RC_ASSERT(std::abs(work_j) < 1e-5);
}

}  // namespace
}  // namespace mechane::hand
