#include <array>
#include <bit>

#include <gtest/gtest.h>

#include "server/collision/object.hpp"
#include "server/collision/superquadric_object.hpp"
#include "server/collision_build/object_builder.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/shapes.hpp"

namespace mechane::collision {
namespace {

std::vector<PointContact> contacts_of(const Object& a, const Pose& X_WA, const Object& b, const Pose& X_WB,
                                      std::size_t capacity = 4096) {
  std::vector<PointContact> storage(capacity);
  ContactBuffer buffer(storage);
  find_contacts(a, X_WA, b, X_WB, buffer);
  return {buffer.contacts().begin(), buffer.contacts().end()};
}

/// A finger's last phalanx, pointing along z.
Object finger() {
  geometry::Superquadric shape;
  shape.a = {0.008, 0.008, 0.015};
  shape.e1 = 0.7;
  return make_superquadric_object(shape, 0.003);
}

Object built(const std::vector<geometry::NamedMesh>& parts, double spacing_m = 0.005) {
  collision_build::BuildConfig config;
  config.sample_spacing_m = spacing_m;
  auto object = collision_build::build_object(parts, config);
  EXPECT_TRUE(object);
  return std::move(*object);
}

TEST(FindContacts, AFingerOnAPlankIsPushedUp) {
  const Object plank = built({{"plank", test::box({0.2, 0.1, 0.01})}});
  const Pose X_WA{{0.013, 0.021, 0.01 + 0.015 - 0.002}, Quat::Identity()};  // 2 mm into the top
  const auto contacts = contacts_of(finger(), X_WA, plank, {});
  ASSERT_GE(contacts.size(), 2U);
  double deepest = 0;
  for (const PointContact& c : contacts) {
    EXPECT_GT(c.n_BA_W.z(), 0.8);  // the finger's own samples see +z; the plank's see the fingertip's curve
    EXPECT_NEAR(c.n_BA_W.norm(), 1, 1e-5);
    EXPECT_NEAR(c.p_WC.z(), 0.01, 1e-4);  // on B's surface, whichever body the sample is of
    deepest = std::max(deepest, c.depth_m);
  }
  EXPECT_NEAR(deepest, 0.002, 2e-4);
}

TEST(FindContacts, SwappedObjectsGiveFlippedNormals) {
  const Object plank = built({{"plank", test::box({0.2, 0.1, 0.01})}});
  const Object tip = finger();
  const Pose X_WA{{0.013, 0.021, 0.023}, quat_from_rotation_vector({0.2, 0.1, 0})};
  const Pose X_WB{{0, 0, 0.001}, quat_from_rotation_vector({0, 0, 0.3})};
  const auto ab = contacts_of(tip, X_WA, plank, X_WB);
  const auto ba = contacts_of(plank, X_WB, tip, X_WA);
  ASSERT_EQ(ab.size(), ba.size());
  ASSERT_GT(ab.size(), 1U);
  for (const PointContact& c : ab) {
    int partners = 0;
    for (const PointContact& d : ba) {
      // The other object's surface: the point moved by the depth against the normal.
      const bool same = (c.p_WC - c.depth_m * c.n_BA_W - d.p_WC).norm() < 1e-6 && (c.n_BA_W + d.n_BA_W).norm() < 1e-5 &&
                        std::abs(c.depth_m - d.depth_m) < 1e-7 && c.part_a == d.part_b && c.part_b == d.part_a;
      partners += same ? 1 : 0;
    }
    EXPECT_EQ(partners, 1);
  }
}

TEST(FindContacts, FarApartOrFiveCentimetresBesideIsNothing) {
  const Object crank = built(test::crank());
  const Object tip = finger();
  EXPECT_TRUE(contacts_of(tip, {{10, 0, 0}, Quat::Identity()}, crank, {}).empty());
  const Vec3 grip(0.21, 0, 0.165);
  EXPECT_TRUE(contacts_of(tip, {grip + Vec3(0.017 + 0.008 + 0.05, 0, 0), Quat::Identity()}, crank, {}).empty());
  EXPECT_TRUE(contacts_of(tip, {grip + Vec3(0, 0.017 + 0.008 + 0.0005, 0), Quat::Identity()}, crank, {}).empty());
  EXPECT_FALSE(contacts_of(tip, {grip + Vec3(0, 0.017 + 0.008 - 0.001, 0), Quat::Identity()}, crank, {}).empty());
}

TEST(FindContacts, AFingerEntersABarrelAndFeelsItsWallFromInside) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Object barrel = built(test::barrel(16, 0.13, 0.15, 0.3, 4), 0.01);
  const Object tip = finger();
  for (double z = -0.4; z <= 0.4; z += 0.01) {  // down the middle, and half way to the wall
    EXPECT_TRUE(contacts_of(tip, {{0, 0, z}, Quat::Identity()}, barrel, {}).empty());
    EXPECT_TRUE(contacts_of(tip, {{0.07, 0.05, z}, Quat::Identity()}, barrel, {}).empty());
  }
  for (int i = 0; i < 64; ++i) {  // all around, also across the seams
    const double angle = 2 * kPi * i / 64;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const auto clear = contacts_of(tip, {out * (0.13 - 0.008 - 0.0015), Quat::Identity()}, barrel, {});
    EXPECT_TRUE(clear.empty()) << "angle " << angle;
    const auto touching = contacts_of(tip, {out * (0.13 - 0.008 + 0.001), Quat::Identity()}, barrel, {});
    ASSERT_FALSE(touching.empty()) << "angle " << angle;
    for (const PointContact& c : touching) {
      EXPECT_LT(c.n_BA_W.dot(out), -0.7) << "angle " << angle;
      EXPECT_LT(c.depth_m, 0.0025) << "angle " << angle;
    }
  }
}

TEST(FindContacts, AFullBufferKeepsTheDeepest) {
  const Object plank = built({{"plank", test::box({0.2, 0.1, 0.01})}});
  const Pose X_WA{{0.013, 0.021, 0.022}, Quat::Identity()};
  auto all = contacts_of(finger(), X_WA, plank, {});
  const auto few = contacts_of(finger(), X_WA, plank, {}, 3);
  ASSERT_GT(all.size(), 3U);
  ASSERT_EQ(few.size(), 3U);
  std::sort(all.begin(), all.end(), [](const auto& l, const auto& r) { return l.depth_m > r.depth_m; });
  for (const PointContact& c : few)
    EXPECT_GE(c.depth_m, all[2].depth_m);
  EXPECT_TRUE(contacts_of(finger(), X_WA, plank, {}, 0).empty());
}

TEST(FindContacts, AllocatesNothingAndRepeatsItselfToTheBit) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("it samples a thousand times what its neighbours sample");
  const Object barrel = built(test::barrel(8, 0.13, 0.15, 0.3, 4), 0.02);
  const Object tip = finger();
  const Pose X_WA{{0.125, 0.01, 0.05}, quat_from_rotation_vector({0.3, 0.2, 0.1})};
  std::array<PointContact, 64> first;
  std::array<PointContact, 64> second;
  ContactBuffer one(first);
  ContactBuffer two(second);
  test::AllocationGuard guard;
  find_contacts(tip, X_WA, barrel, {}, one);
  find_contacts(tip, X_WA, barrel, {}, two);
  EXPECT_EQ(guard.allocations(), 0U);
  ASSERT_EQ(one.contacts().size(), two.contacts().size());
  ASSERT_FALSE(one.contacts().empty());
  for (std::size_t i = 0; i < one.contacts().size(); ++i) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(first[i].depth_m), std::bit_cast<std::uint64_t>(second[i].depth_m));
    EXPECT_EQ(first[i].p_WC, second[i].p_WC);
  }
}

TEST(FindContacts, PosesThatAreNotNumbersTouchNothing) {
  const Object tip = finger();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contacts_of(tip, {{nan, 0, 0}, Quat::Identity()}, tip, {}).empty());
  EXPECT_TRUE(contacts_of(tip, {{0, 0, 0}, Quat(nan, 0, 0, 0)}, tip, {}).empty());
}

}  // namespace
}  // namespace mechane::collision
