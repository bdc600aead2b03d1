// A hand that holds a body: pulls it along, within its limits, and feels it.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/dynamics/scene.hpp"

namespace mechane::dynamics::test {
namespace {

state::WorldDescription free_block(double mass_kg) {
  state::WorldDescription out;
  out.bodies = {body("BLOCK", mass_kg, Vec3(0.01, 0.01, 0.01) * mass_kg)};
  return out;
}

/// A crank: a wheel whose handle, by the tests, is 0.25 m away from the axle, along x at angle 0.
state::WorldDescription crank() {
  return wheel(0.05);
}

void move_hand(Scene& scene, const Vec3& p_WH, const Vec3& v_WH) {
  scene.state->users[0].X_WH.p = p_WH;
  scene.state->users[0].V_WH.v = v_WH;
}

TEST(Grasp, BeginsWithoutAJump) {
  Scene scene(free_block(0.5));
  scene.at(0).X_WB = {Vec3(0.2, 1, -0.3), Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  hold(scene, 0, Vec3(0.05, 0.1, 0), 20, 1);
  scene.state->users[0].X_WH.R = Quat(Eigen::AngleAxisd(2.5, Vec3::UnitX()));
  scene.state->users[0].grasp.X_HB = scene.state->users[0].X_WH.inverse() * scene.at(0).X_WB;
  const Pose before = scene.at(0).X_WB;
  scene.run(0.5);
  EXPECT_LT((scene.at(0).X_WB.p - before.p).norm(), 1e-9);
  EXPECT_LT(scene.state->users[0].grasp.reaction_W.f.norm(), 1e-6);
}

TEST(Grasp, PullsAFreeBodyAlongAndTurnsItWithTheHand) {
  Scene scene(free_block(0.5));
  hold(scene, 0, Vec3(0.02, 0, 0), 20, 1);
  const Vec3 from = scene.state->users[0].X_WH.p;
  for (int n = 0; n < 2000; ++n) {
    const double s = std::min(1.0, n / 1000.0);
    const Quat turn(Eigen::AngleAxisd(0.5 * s, Vec3::UnitZ()));
    move_hand(scene, from + s * Vec3(0.3, 0.2, 0), n < 1000 ? Vec3(0.3, 0.2, 0) : Vec3::Zero());
    scene.state->users[0].X_WH.R = turn;
    scene.state->users[0].V_WH.w = n < 1000 ? Vec3(0, 0, 0.5) : Vec3::Zero();
    scene.run(kStep);
  }
  const Pose wanted = scene.state->users[0].X_WH * scene.state->users[0].grasp.X_HB;
  EXPECT_LT((scene.at(0).X_WB.p - wanted.p).norm(), 1e-4);
  EXPECT_NEAR(rotation_vector(scene.at(0).X_WB.R).z(), 0.5, 1e-3);
}

TEST(Grasp, CarriesTheWeightAndFeelsIt) {
  state::WorldDescription world = free_block(0.4);
  world.bodies[0].use_gravity = true;
  Scene scene(world);
  hold(scene, 0, Vec3::Zero(), 20, 1);
  scene.run(2);
  const Wrench& felt = scene.state->users[0].grasp.reaction_W;
  EXPECT_NEAR(felt.f.y(), -0.4 * 9.81, 1e-3) << "the body pulls the hand down";
  EXPECT_LT(std::hypot(felt.f.x(), felt.f.z()), 1e-6);
  EXPECT_NEAR(scene.at(0).X_WB.p.y(), -0.4 * 9.81 / world.bodies[0].haptic.stiffness_n_per_m, 1e-5) << "sag m g / k";
}

RC_GTEST_PROP(Grasp, NeverPullsHarderThanItsLimits, ()) {
  const auto number = [](int most) { return *rc::gen::inRange(-most, most + 1); };
  Scene scene(free_block(0.2 + 0.1 * *rc::gen::inRange(0, 30)));
  const double force = 1 + *rc::gen::inRange(0, 20), torque = 0.05 * (1 + *rc::gen::inRange(0, 20));
  hold(scene, 0, 0.01 * Vec3(number(5), number(5), number(5)), force, torque);
  scene.state->users[0].freshness = 0.1 * *rc::gen::inRange(0, 11);
  const Vec3 v = 0.1 * Vec3(number(30), number(30), number(30));
  const Vec3 w = Vec3(number(20), number(20), number(20));
  for (int n = 0; n < 300; ++n) {
    state::UserState& user = scene.state->users[0];
    move_hand(scene, user.X_WH.p + v * kStep, v);
    user.V_WH.w = w;
    user.X_WH.R = (quat_from_rotation_vector(w * kStep) * user.X_WH.R).normalized();
    scene.run(kStep);
    RC_ASSERT(user.grasp.reaction_W.f.norm() <= 1.061 * force * user.freshness + 1e-9);
    RC_ASSERT(user.grasp.reaction_W.t.norm() <= 1.061 * torque * user.freshness + 1e-9);
    RC_ASSERT(scene.at(0).X_WB.p.allFinite());
  }
}

TEST(Grasp, OfAMaterialWithoutStiffnessMovesNothing) {
  state::WorldDescription world = crank();
  world.bodies[1].haptic.stiffness_n_per_m = 0;
  Scene scene(world);
  hold(scene, 1, Vec3(0.25, 0, 0), 20, 1);
  for (int n = 0; n < 1000; ++n) {
    move_hand(scene, 0.25 * Vec3(std::cos(n * 0.004), std::sin(n * 0.004), 0), Vec3::Zero());
    scene.run(kStep);
  }
  EXPECT_EQ(scene.hinge().position, 0);
}

/// Circles the hand about the axle for `turns`, then lets go.
void turn_crank(Scene& scene, double radius, double rate, double turns) {
  const int ticks = static_cast<int>(2 * kPi * turns / rate / kStep);
  for (int n = 1; n <= ticks; ++n) {
    const double angle = rate * n * kStep;
    move_hand(scene, radius * Vec3(std::cos(angle), std::sin(angle), 0),
              rate * radius * Vec3(-std::sin(angle), std::cos(angle), 0));
    scene.run(kStep);
  }
}

TEST(Grasp, ACirclingHandTurnsTheCrankByTheSameAngle) {
  Scene scene(crank());
  scene.hinge().friction = 0.2;
  hold(scene, 1, Vec3(0.25, 0, 0), 12, 0.05);
  turn_crank(scene, 0.25, 5.0, 7.25);
  EXPECT_NEAR(scene.hinge().position, 2 * kPi * 7.25, 0.02) << "the wrist did not turn, the handle turned in the hand";
  const Vec3 tangent(-std::sin(scene.hinge().position), std::cos(scene.hinge().position), 0);
  const double felt = scene.state->users[0].grasp.reaction_W.f.dot(tangent);
  EXPECT_NEAR(felt, -(0.2 + 0.05) / 0.25, 0.03) << "the bearing's friction and the handle's slip, at the handle";
  // The handle's 5 N cm of slip drag are the torque limit.
  EXPECT_NEAR(scene.state->users[0].grasp.reaction_W.t.norm(), 0.05, 0.005);
}

TEST(Grasp, AHeavyLoadHoldsAWeakHandBack) {
  Scene scene(crank());
  scene.hinge().friction = 2.0;
  hold(scene, 1, Vec3(0.25, 0, 0), 6, 0.05);  // 6 N * 0.25 m < 2 N m
  turn_crank(scene, 0.25, 5.0, 1);
  EXPECT_LT(std::abs(scene.hinge().position), 1e-6);
}

TEST(Grasp, AReleasedCrankCoastsAndStops) {
  Scene scene(crank());
  scene.hinge().friction = 0.2;
  hold(scene, 1, Vec3(0.25, 0, 0), 12, 0.05);
  turn_crank(scene, 0.25, 5.0, 2);
  scene.state->users[0].grasp = {};
  const double at_release = scene.hinge().position;
  scene.run(kStep);
  EXPECT_NEAR(scene.hinge().velocity, 5.0, 0.1) << "it goes on as it was turned";
  scene.run(4);
  EXPECT_EQ(std::abs(scene.hinge().velocity) < 1e-9, true);
  EXPECT_NEAR(scene.hinge().position - at_release, 0.05 * 25 / (2 * 0.2), 0.15) << "I w^2 / (2 M)";
}

TEST(Grasp, ALongBodyHeldAtItsEndArrivesStraight) {
  // The screw of the exhibit as the hand feels it, hung in slings: 2.4 m, carried 0.8 m in 4 s by its crank's handle.
  state::WorldDescription world;
  world.bodies = {body("SCREW", 42, {20.4, 20.3, 0.35})};
  world.bodies[0].effort_scale = 0.048;
  Scene scene(world);
  const Vec3 p_BG(0.25, 0, 1.36);
  hold(scene, 0, p_BG, 12, 2.5);
  for (int n = 1; n <= 4500; ++n) {
    const double s = std::min(1.0, n / 4000.0), way = s * s * s * (10 - 15 * s + 6 * s * s);
    const double speed = 30 * s * s * (1 - s) * (1 - s) / 4;
    move_hand(scene, p_BG + way * Vec3(0, -0.25, -0.75), speed * Vec3(0, -0.25, -0.75));
    scene.run(kStep);
    ASSERT_LT(rotation_vector(scene.at(0).X_WB.R).norm(), 0.1) << "after " << n << " ms";
  }
  EXPECT_LT((scene.at(0).X_WB.p - Vec3(0, -0.25, -0.75)).norm(), 0.005);
  EXPECT_LT(rotation_vector(scene.at(0).X_WB.R).norm(), 0.005);
}

TEST(Grasp, ABodyThatIsPushedAsideComesBackUnlessItSlips) {
  for (const bool slips : {false, true}) {
    Scene scene(free_block(0.5));
    hold(scene, 0, Vec3::Zero(), 20, 0.2);
    double farthest = 0;
    for (int n = 0; n < 3000; ++n) {
      if (n < 1000) scene.at(0).load_W.t = Vec3(0, 0, slips || n < 60 ? 0.3 : 0.0);
      scene.run(kStep);
      farthest = std::max(farthest, rotation_vector(scene.at(0).X_WB.R).z());
    }
    EXPECT_EQ(farthest > 0.6, slips);
    EXPECT_EQ(std::abs(rotation_vector(scene.at(0).X_WB.R).z()) < 1e-3, !slips) << farthest;
  }
}

TEST(Grasp, TwoHandsOnOneBodyShareItsWeight) {
  state::WorldDescription world = free_block(0.6);
  world.bodies[0].use_gravity = true;
  Scene scene(world);
  hold(scene, 0, Vec3(0.2, 0, 0), 20, 1);
  scene.state->users[1] = scene.state->users[0];
  scene.state->users[1].X_WH.p = Vec3(-0.2, 0, 0);
  scene.state->users[1].grasp.p_BG = Vec3(-0.2, 0, 0);
  scene.state->users[1].grasp.X_HB.p = Vec3(0.2, 0, 0);
  scene.run(3);
  for (int u = 0; u < 2; ++u)
    EXPECT_NEAR(scene.state->users[u].grasp.reaction_W.f.y(), -0.3 * 9.81, 1e-2);
}

}  // namespace
}  // namespace mechane::dynamics::test
