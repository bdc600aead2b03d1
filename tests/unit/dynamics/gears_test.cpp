// Gears, worms, one-tooth gears and ratchets against closed forms.
#include <cmath>

#include "tests/unit/dynamics/coupled.hpp"

namespace mechane::dynamics::test {
namespace {

using state::JointKind;

double rate(Coupled& scene, std::size_t joint) {
  return scene.joint_at(joint).velocity;
}

TEST(Gear, TorqueAcceleratesBothWheelsAsTheirReflectedInertiaSays) {
  const double ratio = -2.5, I1 = 0.05, I2 = 0.02, M = 0.3;
  Coupled scene(wheels({I1, I2}), {gear(0, 1, ratio)});
  for (int n = 0; n < 1000; ++n) {
    scene.joint_at(0).load = M;
    scene.run(kStep);
  }
  const double expected = M / (I1 + ratio * ratio * I2);
  EXPECT_NEAR(rate(scene, 0), expected, 1e-6 * expected);
  EXPECT_NEAR(rate(scene, 1), ratio * expected, 1e-6 * expected);
  EXPECT_NEAR(scene.coupling().torque_nm, I2 * std::abs(ratio) * expected, 1e-6) << "what accelerates the second";
}

TEST(Gear, HoldsItsRatioThroughReversals) {
  const double ratio = -400.0 / 21;
  Coupled scene(wheels({0.05, 0.003}), {gear(0, 1, ratio)});
  double farthest = 0;
  for (int n = 0; n < 20000; ++n) {
    scene.joint_at(0).load = 3 * std::cos(3e-3 * n);
    scene.joint_at(1).friction = 0.01;
    scene.run(kStep);
    farthest = std::max(farthest, std::abs(scene.joint_at(0).position));
    ASSERT_LT(std::abs(ratio * scene.joint_at(0).position - scene.joint_at(1).position), 1e-6) << n;
  }
  EXPECT_GT(farthest, 0.3) << "it went to and fro";
}

TEST(Gear, AWheelThatMeshesInMotionSharesItsMomentumAndLosesWhatAShockLoses) {
  const double ratio = 3, I1 = 0.05, I2 = 0.02, w = 7;
  Coupled scene(wheels({I1, I2}), {gear(0, 1, ratio)});
  scene.at(1).V_WB.w = Vec3(0, 0, w);
  scene.run(kStep);
  const double after = I1 * w / (I1 + ratio * ratio * I2);
  EXPECT_NEAR(rate(scene, 0), after, 1e-9);
  EXPECT_NEAR(energy_of(scene), 0.5 * (I1 + ratio * ratio * I2) * after * after, 1e-9);
}

TEST(Gear, OnAFreeFrameKeepsLinearAndAngularMomentum) {
  state::WorldDescription world = wheels({0.05, 0.02});
  world.bodies[0] = body("FRAME", 3, {0.1, 0.2, 0.3});
  world.bodies[1].p_BCm = Vec3(0.02, 0.01, 0);  // off its axis, so that the bearing bears something
  Coupled scene(world, {gear(0, 1, -2)});
  scene.at(1).V_WB.w = Vec3(0, 0, 9);
  scene.at(0).V_WB = {Vec3(0.3, -0.1, 0.2), Vec3(0, 0, 1)};
  const auto momentum = [&] {
    Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      const state::BodyDescription& body = world.bodies[i];
      const state::BodyState& at = scene.at(i);
      const Vec3 cm = at.X_WB * body.p_BCm, v = at.V_WB.at(cm - at.X_WB.p);
      linear += body.mass_kg * v;
      angular += body.mass_kg * cm.cross(v) + at.X_WB.R * (body.inertia_kg_m2 * (at.X_WB.R.conjugate() * at.V_WB.w));
    }
    return std::pair(linear, angular);
  };
  const auto before = momentum();
  for (int n = 0; n < 500; ++n) {
    scene.run(kStep);
    const auto now = momentum();
    ASSERT_LT((now.first - before.first).norm(), 1e-9);
    ASSERT_LT((now.second - before.second).norm(), 5e-3 * before.second.norm()) << n;
    if (n > 20) {
      ASSERT_NEAR(rate(scene, 1), -2 * rate(scene, 0), 1e-3 * std::abs(rate(scene, 0))) << n;
    }
  }
}

TEST(Gear, RackAndPinionLiftAWeightByTheRadius) {
  const double r = 0.1, I = 0.05, m = 3, M = 4;
  state::WorldDescription world = wheels({I});
  add_weight(world, m, Vec3(2, 0, 0));
  Coupled scene(world, {gear(0, 1, r)});
  for (int n = 0; n < 500; ++n) {
    scene.joint_at(0).load = M;
    scene.run(kStep);
  }
  const double expected = (M - m * 9.81 * r) / (I + m * r * r) * 0.5;
  EXPECT_NEAR(rate(scene, 0), expected, 1e-6);
  EXPECT_NEAR(rate(scene, 1), r * expected, 1e-6);
  EXPECT_NEAR(scene.joint_at(1).position, r * scene.joint_at(0).position, 1e-9);
  EXPECT_NEAR(scene.coupling().force_n, m * (9.81 + 2 * r * expected), 1e-5) << "the rack's tooth force";
}

TEST(Gear, AJointThatIsOffMeshesWithNothing) {
  Coupled scene(wheels({0.05, 0.02}), {gear(0, 1, 1)});
  scene.joint_at(1).enabled = false;
  scene.at(1).V_WB.w = Vec3(0, 0, 4);
  scene.run(0.1);
  EXPECT_NEAR(rate(scene, 0), 4, 1e-9);
  EXPECT_EQ(scene.coupling().torque_nm, 0);
}

TEST(Gear, TrainsOfManyWheelsTurnAsOne) {
  // 1 : 2 : 4 : ... : 64, the last reflected 4096 times.
  Coupled scene(wheels({0.01, 0.01, 0.01, 0.01, 0.01, 0.01, 0.01}),
                {gear(0, 1, -2), gear(1, 2, -2), gear(2, 3, -2), gear(3, 4, -2), gear(4, 5, -2), gear(5, 6, -2)});
  double reflected = 0;
  for (int i = 0; i < 7; ++i)
    reflected += 0.01 * std::pow(4, i);
  for (int n = 0; n < 1000; ++n) {
    scene.joint_at(0).load = 5;
    scene.run(kStep);
  }
  EXPECT_NEAR(rate(scene, 0), 5 / reflected, 1e-9);
  EXPECT_NEAR(rate(scene, 6), 64 * 5 / reflected, 1e-7);
}

TEST(Gear, WheelsThatRunInARingAndCannotTurnStandStill) {
  Coupled scene(wheels({0.05, 0.05, 0.05}), {gear(0, 1, -1), gear(1, 2, -1), gear(2, 0, -1)});
  for (int n = 0; n < 500; ++n) {
    scene.joint_at(0).load = 1;
    scene.run(kStep);
  }
  EXPECT_LT(std::abs(rate(scene, 0)), 1e-3);
  EXPECT_LT(std::abs(scene.joint_at(0).position), 1e-3);
}

TEST(Worm, DrivesItsWheelAtItsEfficiencyAndIsNotDriven) {
  const double ratio = 1.0 / 30, efficiency = 0.4, r = 0.1, m = 20;
  state::WorldDescription world = wheels({0.001, 0.05});
  add_weight(world, m, Vec3(3, 0, 0));
  Coupled scene(world, {gear(0, 1, ratio, efficiency), gear(1, 2, r)});
  scene.run(2);
  EXPECT_LT(std::abs(scene.joint_at(1).position), 1e-6) << "the weight on the wheel does not turn the worm";
  EXPECT_LT(std::abs(rate(scene, 0)), 1e-6);
  const double least = m * 9.81 * r * ratio / efficiency;
  const auto turned_by = [&](double torque) {
    const double from = scene.joint_at(0).position;
    for (int n = 0; n < 300; ++n) {
      scene.joint_at(0).load = torque;
      scene.run(kStep);
    }
    return scene.joint_at(0).position - from;
  };
  EXPECT_LT(std::abs(turned_by(0.97 * least)), 1e-4) << "not enough to lift";
  EXPECT_GT(turned_by(1.03 * least), 0.1) << "enough to lift";
  scene.run(1);
  EXPECT_LT(-turned_by(-0.97 * m * 9.81 * r * ratio * (1 / efficiency - 2)), 1e-4);
  EXPECT_GT(scene.joint_at(2).position, 1e-4) << "let down it is only by turning the worm back";
}

TEST(OneTooth, MovesTheWheelByOneOfItsTeethATurnAndHoldsItElse) {
  const double step = -2 * kPi / 8, window = 0.5;
  Coupled scene(wheels({0.5, 0.002}), {one_tooth(0, 1, step, window)});
  int moving = 0, ticks = 0;
  while (scene.joint_at(0).position < 2 * kPi * 3.25) {
    scene.joint_at(0).load = 2.0 * (4 - rate(scene, 0));  // kept at about 4 rad/s
    scene.run(kStep);
    moving += std::abs(rate(scene, 1)) > 1e-4 ? 1 : 0;
    ASSERT_LT(++ticks, 10000);
  }
  EXPECT_NEAR(scene.joint_at(1).position, 3 * step, 1e-4);
  EXPECT_NEAR(static_cast<double>(moving) / ticks, 3 * window / (2 * kPi * 3.25), 0.02) << "it dwells in between";
  scene.joint_at(1).load = 0;
  while (scene.joint_at(0).position > 0) {
    scene.joint_at(0).load = 2.0 * (-4 - rate(scene, 0));
    scene.run(kStep);
    ASSERT_LT(++ticks, 20000);
  }
  EXPECT_NEAR(scene.joint_at(1).position, 0, 1e-4) << "and back";
}

TEST(OneTooth, HeldWheelDoesNotTurnUnderALoadAndAFreeOneDoes) {
  for (const bool lock : {true, false}) {
    state::Coupling tooth = one_tooth(0, 1, 0.1);
    tooth.lock = lock;
    Coupled scene(wheels({0.5, 0.002}), {tooth});
    for (int n = 0; n < 200; ++n) {
      scene.joint_at(1).load = 0.01;
      scene.run(kStep);
    }
    EXPECT_EQ(std::abs(scene.joint_at(1).position) < 1e-6, lock);
  }
}

TEST(Stop, HoldsALoadedDrumAndLetsItGoOn) {
  Coupled scene(wheels({0.05}), {stop(0, 0)});
  for (int n = 0; n < 1000; ++n) {
    scene.joint_at(0).load = -3;
    scene.run(kStep);
  }
  EXPECT_NEAR(scene.joint_at(0).position, 0, 1e-6);
  EXPECT_NEAR(scene.coupling().torque_nm, 3, 1e-6);
  for (int n = 0; n < 500; ++n) {
    scene.joint_at(0).load = 1;
    scene.run(kStep);
  }
  EXPECT_NEAR(rate(scene, 0), 10, 1e-6) << "the other way it is not there";
  EXPECT_EQ(scene.coupling().torque_nm, 0);
}

TEST(Stop, BehindAGearHoldsTheWholeTrain) {
  Coupled scene(wheels({0.05, 0.02}), {gear(0, 1, -4), stop(1, 0.5, -1)});
  for (int n = 0; n < 2000; ++n) {
    scene.joint_at(0).load = -2;
    scene.run(kStep);
  }
  EXPECT_NEAR(scene.joint_at(1).position, 0.5, 1e-6);
  EXPECT_NEAR(scene.coupling(1).torque_nm, 0.5, 1e-6) << "a quarter of the torque before the gear";
}

}  // namespace
}  // namespace mechane::dynamics::test
