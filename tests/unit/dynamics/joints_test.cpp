// Joints against closed forms.
#include <cmath>

#include "tests/support/error_like.hpp"
#include "tests/unit/dynamics/scene.hpp"

namespace mechane::dynamics::test {
namespace {

using state::JointKind;

Pose about_z(double angle) {
  return {Vec3::Zero(), Quat(Eigen::AngleAxisd(angle, Vec3::UnitZ()))};
}

/// A point-like weight at the end of a light arm, hinged at the origin about z; hanging is angle 0.
state::WorldDescription pendulum(double length_m, double start_rad) {
  state::WorldDescription out;
  state::BodyDescription weight = body("WEIGHT", 1.5, {1e-5, 1e-5, 1e-5});
  weight.use_gravity = true;
  weight.p_BCm = Vec3(0, -length_m, 0);
  weight.X_WB = about_z(start_rad);
  out.bodies = {fixed_body("FRAME"), weight};
  out.joints = {joint(JointKind::hinge)};
  return out;
}

TEST(Pendulum, SwingsWithThePeriodOfTheClosedForm) {
  const double length = 0.5, amplitude = 0.4;
  Scene scene(pendulum(length, amplitude));
  // T = 4 sqrt(l/g) K(sin(a/2)): the complete elliptic integral, by the arithmetic-geometric mean.
  const double inertia_ratio = 1 + 1e-5 / (1.5 * length * length);
  double a = 1, b = std::cos(amplitude / 2);
  for (int i = 0; i < 8; ++i)
    std::tie(a, b) = std::pair{(a + b) / 2, std::sqrt(a * b)};
  const double period = 2 * kPi * std::sqrt(inertia_ratio * length / 9.81) / a;

  scene.run(kStep);  // the joint's position is measured by a step
  double last = scene.hinge().position, crossed_s = 0;
  for (int n = 1; crossed_s == 0; ++n) {
    ASSERT_LT(n, 5000);
    scene.run(kStep);
    const double now = scene.hinge().position;
    if (last < 0 && now >= 0)
      crossed_s = (n + 1 - now / (now - last)) * kStep;  // upwards through the bottom: 3/4 of a period
    last = now;
  }
  EXPECT_NEAR(crossed_s, 0.75 * period, 0.003 * period);
}

TEST(Pendulum, NeverGainsEnergyAndStaysOnItsHinge) {
  const double length = 0.5;
  Scene scene(pendulum(length, 1.2));
  const auto energy = [&] {
    const state::BodyState& b = scene.at(1);
    const Vec3 cm = b.X_WB * Vec3(0, -length, 0);
    const Vec3 v = b.V_WB.at(cm - b.X_WB.p);
    return 1.5 * (0.5 * v.squaredNorm() + 9.81 * cm.y()) + 0.5e-5 * b.V_WB.w.squaredNorm();
  };
  const double start = energy(), depth = 1.5 * 9.81 * length * (1 - std::cos(1.2));
  for (int n = 0; n < 10000; ++n) {
    scene.run(kStep);
    ASSERT_LE(energy(), start + 0.01 * depth) << "after " << n << " ms";
    ASSERT_LT(scene.at(1).X_WB.p.norm(), 1e-3);
  }
  EXPECT_GT(energy(), start - 0.3 * depth) << "it should still be swinging";
}

TEST(Hinge, LoadAgainstViscousDragReachesTheirBalance) {
  Scene scene(wheel(0.05));
  scene.hinge().viscous = 0.2;
  scene.hinge().friction = 0.3;
  for (int n = 0; n < 4000; ++n) {
    scene.hinge().load = 1.1;
    scene.run(kStep);
  }
  EXPECT_NEAR(scene.hinge().velocity, (1.1 - 0.3) / 0.2, 1e-3);
  EXPECT_EQ(scene.hinge().load, 0) << "a load holds for one tick";
}

TEST(Hinge, FrictionHoldsWhatIsBelowItAndNeverDrives) {
  Scene scene(wheel(0.05));
  scene.hinge().friction = 0.2;
  for (int n = 0; n < 1000; ++n) {
    scene.hinge().load = 0.29;
    scene.hinge().resistance = 0.1;
    scene.run(kStep);
  }
  EXPECT_LT(std::abs(scene.hinge().position), 1e-9);
  EXPECT_LT(std::abs(scene.hinge().velocity), 1e-9);
}

TEST(Hinge, CoastsAndStopsByFrictionWhereTheClosedFormSays) {
  Scene scene(wheel(0.05));
  scene.hinge().friction = 0.1;
  scene.at(1).V_WB.w = Vec3(0, 0, 20);
  scene.run(15);
  EXPECT_LT(std::abs(scene.hinge().velocity), 1e-12);
  EXPECT_NEAR(scene.hinge().position, 0.05 * 20 * 20 / (2 * 0.1), 0.05) << "I w^2 / (2 M), many turns on";
}

TEST(Hinge, StopsAtItsLimitAndGoesNoFurther) {
  Scene scene(wheel(0.05));
  scene.hinge().min_position = -0.5;
  scene.hinge().max_position = 0.75;
  for (int n = 0; n < 3000; ++n) {
    scene.hinge().load = n < 1500 ? 2.0 : -2.0;
    scene.run(kStep);
    ASSERT_LT(scene.hinge().position, 0.75 + 1e-3);
    ASSERT_GT(scene.hinge().position, -0.5 - 1e-3);
    if (n == 1499) {
      EXPECT_NEAR(scene.hinge().position, 0.75, 1e-3);
    }
  }
  EXPECT_NEAR(scene.hinge().position, -0.5, 1e-3);
}

TEST(Hinge, SwitchedOffLetsTheBodyGo) {
  Scene scene(wheel(0.05));
  scene.at(1).V_WB.w = Vec3(0, 0, 3);
  scene.run(0.5);
  const double position = scene.hinge().position;
  scene.hinge().enabled = false;
  scene.at(1).load_W.f = Vec3(0, 0, 200);  // one tick: 0.1 m/s
  scene.run(1);
  EXPECT_NEAR(scene.at(1).X_WB.p.z(), 0.1, 1e-3);
  EXPECT_EQ(scene.hinge().position, position);
  EXPECT_EQ(scene.hinge().velocity, 0);
}

TEST(Slider, AcceleratesAlongItsAxisAloneAndStopsAtItsLimit) {
  state::WorldDescription world;
  world.bodies = {fixed_body("FRAME"), body("SLED", 2)};
  world.bodies[1].use_gravity = true;
  world.bodies[1].p_BCm = Vec3(0, 0.1, 0.05);
  world.joints = {joint(JointKind::slider)};
  Scene scene(world);
  scene.hinge().max_position = 0.4;
  for (int n = 0; n < 500; ++n) {
    scene.hinge().load = 4;
    scene.run(kStep);
  }
  EXPECT_NEAR(scene.hinge().position, 0.25, 0.002) << "a t^2 / 2 with 4 N on 2 kg";
  EXPECT_NEAR(scene.hinge().velocity, 1.0, 0.002);
  scene.run(1);
  EXPECT_NEAR(scene.hinge().position, 0.4, 1e-3);
  EXPECT_LT(std::abs(scene.at(1).X_WB.p.y()), 1e-3) << "its weight hangs on the slider";
  EXPECT_LT(rotation_vector(scene.at(1).X_WB.R).norm(), 1e-2);
}

TEST(Ball, KeepsItsPointWhileTheBodyTumbles) {
  state::WorldDescription world;
  world.bodies = {fixed_body("FRAME"), body("BOB", 1, {0.002, 0.003, 0.004})};
  world.bodies[1].use_gravity = true;
  world.bodies[1].X_WB.p = Vec3(0.3, 0, 0);
  world.joints = {joint(JointKind::ball, {}, {Vec3(-0.3, 0, 0), Quat::Identity()})};
  Scene scene(world);
  scene.at(1).V_WB.w = Vec3(5, 0, 1);
  double lowest = 0;
  for (int n = 0; n < 3000; ++n) {
    scene.run(kStep);
    ASSERT_LT((scene.at(1).X_WB * Vec3(-0.3, 0, 0)).norm(), 2e-3);
    lowest = std::min(lowest, scene.at(1).X_WB.p.y());
  }
  EXPECT_LT(lowest, -0.2);
}

TEST(Body, FallsByGravityOrNotAndByItsEffortScaleInertiaOnly) {
  state::WorldDescription world;
  world.bodies = {body("STONE", 100), body("CLOUD", 1), body("CART", 100)};
  world.bodies[0].use_gravity = true;
  world.bodies[0].effort_scale = 0.01;
  world.bodies[2].effort_scale = 0.02;
  Scene scene(world);
  for (int n = 0; n < 1000; ++n) {
    scene.at(2).load_W.f = Vec3(1, 0, 0);
    scene.run(kStep);
  }
  EXPECT_NEAR(scene.at(0).X_WB.p.y(), -9.81 / 2, 0.006) << "effort_scale leaves the fall as it is";
  EXPECT_EQ(scene.at(1).X_WB.p.norm(), 0);
  EXPECT_NEAR(scene.at(2).V_WB.v.x(), 0.5, 1e-6) << "1 N for 1 s on 100 kg * 0.02";
}

TEST(Body, HeldStillDoesNotMoveAndIsNotKickedWhenFreed) {
  Scene scene(pendulum(0.5, 0.8));
  scene.at(1).movable = false;
  const Pose before = scene.at(1).X_WB;
  scene.run(1);
  EXPECT_EQ(scene.at(1).X_WB.R.coeffs(), before.R.coeffs());
  scene.at(1).movable = true;
  scene.run(kStep);
  EXPECT_LT(scene.at(1).V_WB.w.norm(), 1.01 * 9.81 * std::sin(0.8) / 0.5 * kStep);
}

TEST(Body, PutElsewhereFromOutsideGoesOnFromThere) {
  Scene scene(wheel(0.05));
  scene.at(1).V_WB.w = Vec3(0, 0, 10);
  scene.run(3);
  scene.at(1).X_WB = scene.description.bodies[1].X_WB;
  scene.at(1).V_WB = {};
  scene.hinge().position = 0;
  scene.run(0.1);
  EXPECT_LT(std::abs(scene.hinge().position), 1e-9) << "the turns are those of the state";
}

TEST(Create, RefusesWhatCannotMove) {
  using mechane::test::is_error;
  const auto error_of = [](const state::WorldDescription& world) {
    const state::WorldState state(world);
    auto made = DynamicsWorld::create(world, state);
    return made ? Error{} : made.error();
  };
  state::WorldDescription world = wheel(0.05);
  world.bodies[1].mass_kg = 0;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, 0, {"body WHEEL", "mass"}));
  world = wheel(0.05);
  world.bodies[1].inertia_kg_m2(2, 2) = -1;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, 0, {"body WHEEL", "positive definite"}));
  world = wheel(0.05);
  world.bodies[1].p_BCm.x() = std::nan("");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, 0, {"body WHEEL", "not finite"}));
  world = wheel(0.05);
  world.joints[0].body2 = BodyId::none();
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, 0, {"joint JOINT"}));
}

TEST(Joints, MoreThanTheSolverHasTablesForAreRefused) {
  state::WorldDescription out;
  out.bodies = {fixed_body("FRAME"), body("WHEEL", 1)};
  out.joints.assign(state::kMaxJoints + 1, joint(JointKind::hinge));
  const state::WorldState state(out);
  using mechane::test::is_error;
  const auto made = DynamicsWorld::create(out, state);
  ASSERT_FALSE(made);
  EXPECT_THAT(made.error(), is_error(ErrorCode::too_large, 0, {"257", "256"}));
}

TEST(Joints, BodiesThatNothingTiesTakeNoTables) {
  state::WorldDescription out;
  out.bodies.assign(20'000, body("GRAIN", 1));  // tables over all pairs would take 115 GB
  Scene scene(out);
  scene.run(kStep);
}

}  // namespace
}  // namespace mechane::dynamics::test
