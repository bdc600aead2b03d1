// Ties, screws, cones and what joints bear, against closed forms; and what the loop asks of couplings.
#include <cmath>

#include "server/state/snapshot.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/coupled.hpp"

namespace mechane::dynamics::test {
namespace {

using state::JointKind;

state::Coupling tie(const Scene& scene, BodyId body1, BodyId body2) {
  state::Coupling out;
  out.kind = state::CouplingKind::fixed;
  out.body1 = body1;
  out.body2 = body2;
  const Pose X_WB1 = body1 ? scene.state->bodies[body1.index()].X_WB : Pose{};
  out.X_B1B2 = X_WB1.inverse() * scene.state->bodies[body2.index()].X_WB;
  return out;
}

state::Coupling watch(std::size_t joint) {
  state::Coupling out;
  out.kind = state::CouplingKind::watch;
  out.joint1 = JointId(joint);
  return out;
}

TEST(Tie, TwoBodiesSpinAsTheOneThatTheyMake) {
  const double m = 2, I = 0.01, d = 0.4;
  state::WorldDescription world;
  world.bodies = {body("A", m, {I, I, I}), body("B", m, {I, I, I})};
  world.bodies[1].X_WB.p = Vec3(d, 0, 0);
  const Scene at(world);
  Coupled scene(world, {tie(at, BodyId(0), BodyId(1))});
  scene.at(0).V_WB.v = Vec3(0, 1, 0);
  scene.run(kStep);
  // Momentum m v, angular momentum m v d / 2 about the middle: v / 2 and w.
  const double w = -(m * d / 2) / (2 * I + 2 * m * d * d / 4);
  EXPECT_NEAR(scene.at(0).V_WB.w.z(), w, 1e-6);
  EXPECT_NEAR(scene.at(1).V_WB.w.z(), w, 1e-6);
  const double start = energy_of(scene);
  scene.run(3);
  EXPECT_NEAR((scene.at(1).X_WB.p - scene.at(0).X_WB.p).norm(), d, 1e-4);
  EXPECT_LT(rotation_vector(scene.at(0).X_WB.R.conjugate() * scene.at(1).X_WB.R).norm(), 1e-4);
  EXPECT_LE(energy_of(scene), 1.01 * start);
  EXPECT_NEAR((0.5 * (scene.at(0).V_WB.v + scene.at(1).V_WB.v) - Vec3(0, 0.5, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR(scene.coupling().force_n, m * w * w * d / 2, 0.01 * m * w * w * d / 2) << "it holds them together";
}

TEST(Tie, BearsAWeightAndItsLever) {
  state::WorldDescription world;
  world.bodies = {body("BEAM", 3)};
  world.bodies[0].use_gravity = true;
  world.bodies[0].p_BCm = Vec3(0.5, 0, 0);
  const Scene at(world);
  Coupled scene(world, {tie(at, {}, BodyId(0))});
  scene.run(0.5);
  EXPECT_NEAR(scene.coupling().force_n, 3 * kGravity, 1e-3);
  EXPECT_NEAR(scene.coupling().torque_nm, 1.5 * kGravity, 1e-3);
  EXPECT_LT(scene.at(0).X_WB.p.norm(), 1e-4);
}

TEST(Watch, SaysWhatAJointBears) {
  // A wheel of 2 kg on a hinge at the origin, its weight 0.3 m off; held by a stop on its axis.
  state::WorldDescription world = wheel(0.05);
  world.bodies[1].use_gravity = true;
  world.bodies[1].p_BCm = Vec3(0.3, 0, 0.1);
  Coupled scene(world, {stop(0, 0), watch(0)});
  scene.run(0.5);
  EXPECT_NEAR(scene.coupling(1).force_n, 2 * kGravity, 1e-3);
  EXPECT_NEAR(scene.coupling(1).torque_nm, 2 * kGravity * 0.1, 1e-3) << "about x: the axis' own torque is the stop's";
  EXPECT_NEAR(scene.coupling(0).torque_nm, 2 * kGravity * 0.3, 1e-3);
}

TEST(Screw, GoesByItsPitchAndPushesAsVirtualWorkSays) {
  const double pitch = 0.03, I = 0.05, m = 2, M = 0.4;
  for (const double sign : {1.0, -1.0}) {
    Scene scene(wheel(I));
    const double per_rad = sign * pitch / (2 * kPi);
    scene.hinge().pitch_m_per_rad = per_rad;
    for (int n = 0; n < 2000; ++n) {
      scene.hinge().load = M;
      scene.run(kStep);
      ASSERT_NEAR(scene.at(1).X_WB.p.z(), per_rad * scene.hinge().position, 1e-9);
    }
    EXPECT_NEAR(scene.hinge().velocity, M / (I + m * per_rad * per_rad) * 2, 1e-6);
    EXPECT_LT(scene.at(1).X_WB.p.head<2>().norm(), 1e-9);
  }
}

TEST(Screw, AWeightTurnsItUnlessFrictionHolds) {
  const double per_rad = 0.02, I = 0.05, m = 2;
  for (const double friction : {0.0, 1.01 * m * kGravity * per_rad}) {
    state::WorldDescription world = wheel(I);
    world.gravity_W = Vec3(0, 0, -kGravity);
    world.bodies[1].use_gravity = true;
    Scene scene(world);
    scene.hinge().pitch_m_per_rad = per_rad;
    scene.hinge().friction = friction;
    scene.run(1);
    const double expected = friction > 0 ? 0 : -m * kGravity * per_rad / (I + m * per_rad * per_rad);
    EXPECT_NEAR(scene.hinge().velocity, expected, 1e-6);
  }
}

TEST(Ball, StaysInItsCone) {
  state::WorldDescription world;
  world.bodies = {fixed_body("FRAME"), body("BOB", 1, {0.002, 0.003, 0.004})};
  world.bodies[1].use_gravity = true;
  world.bodies[1].X_WB.R = quat_from_rotation_vector(Vec3(0.02, 0, 0.05));
  world.bodies[1].X_WB.p = world.bodies[1].X_WB.rotate(Vec3(0, 0.3, 0));
  world.joints = {joint(JointKind::ball, {Vec3(0, 0, 0), Quat::Identity()}, {Vec3(0, -0.3, 0), Quat::Identity()})};
  Scene scene(world);
  scene.hinge().cone_axis_J = Vec3::UnitY();
  scene.hinge().cone_rad = 0.6;
  const double start = energy_of(scene);
  double widest = 0;
  for (int n = 0; n < 5000; ++n) {
    scene.run(kStep);
    const double tilt = std::acos(std::min(1.0, scene.at(1).X_WB.rotate(Vec3::UnitY()).y()));
    ASSERT_LT(tilt, 0.6 + 2e-3);
    ASSERT_LE(energy_of(scene), start + 0.02);
    widest = std::max(widest, tilt);
  }
  EXPECT_GT(widest, 0.59) << "it falls against the cone's edge, and stays there";
}

/// Every kind of coupling in one world.
Coupled everything() {
  state::WorldDescription world = wheels({0.05, 0.02, 0.01, 0.04});
  add_weight(world, 5, Vec3(6, 0, 0));
  world.bodies.push_back(body("LOAD", 0.5));
  world.bodies.back().X_WB.p = Vec3(6, -0.2, 0);
  const Scene at(world);
  state::Coupling over = rope(at, {node(BodyId(4), Vec3::Zero(), 0.1, -1), node({}, Vec3(5, 5, 0), 0.1, -1, 0.9),
                                   node(BodyId(5), Vec3::Zero())});
  over.drum = true;
  over.joint1 = JointId(3);
  over.body1 = BodyId(0);
  return {world,
          {gear(0, 1, -2, 0.8), one_tooth(1, 2, 0.4), gear(1, 3, 0.5), stop(3, -0.05), over,
           tie(at, BodyId(5), BodyId(6)), watch(4)}};
}

void play_all(Coupled& scene, int n) {
  scene.joint_at(0).load = 3 * std::sin(2e-3 * n);
  scene.joint_at(2).friction = 0.01;
  if (n % 1700 == 900) scene.coupling(3).enabled = !scene.coupling(3).enabled;
  if (n % 2300 == 1100) scene.coupling(4).enabled = !scene.coupling(4).enabled;
}

TEST(Couplings, AWorldMadeFromASnapshotGoesOnWithTheSameBits) {
  Coupled live = everything(), resumed = everything();
  std::vector<std::byte> bytes;
  for (int n = 0; n < 6000; ++n) {
    play_all(live, n);
    live.run(kStep);
    if (n == 2345) {
      state::write_snapshot(*live.state, bytes);
      ASSERT_TRUE(state::read_snapshot(bytes, *resumed.state));
    } else if (n > 2345) {
      play_all(resumed, n);
      resumed.run(kStep);
    }
  }
  EXPECT_EQ(state::state_hash(*live.state), state::state_hash(*resumed.state));
  EXPECT_GT(std::abs(live.joint_at(0).position), 0.1);
  EXPECT_TRUE(live.at(5).X_WB.p.allFinite());
}

TEST(Couplings, AStepAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Coupled scene = everything();
  const mechane::test::AllocationGuard guard;
  for (int n = 0; n < 5000; ++n) {
    play_all(scene, n);
    scene.run(kStep);
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(Couplings, RefuseWhatIsNotThere) {
  EXPECT_THROW(Coupled(wheels({0.1}), {gear(0, 1, 2)}), std::runtime_error);
  EXPECT_THROW(Coupled(wheels({0.1, 0.1}), {gear(1, 1, 2)}), std::runtime_error);
  EXPECT_THROW(Coupled(wheels({0.1, 0.1}), {one_tooth(0, 1, 0.1, 0)}), std::runtime_error);
}

}  // namespace
}  // namespace mechane::dynamics::test
