// Ropes over sheaves and drums against closed forms.
#include <cmath>

#include "tests/unit/dynamics/coupled.hpp"

namespace mechane::dynamics::test {
namespace {

/// Two weights on guides under a sheave at the origin, 4 m up.
state::WorldDescription two_weights(double m1, double m2) {
  state::WorldDescription world;
  add_weight(world, m1, Vec3(-0.2, 0, 0));
  add_weight(world, m2, Vec3(0.2, 0, 0));
  return world;
}

Coupled atwood(double m1, double m2, double radius, double efficiency) {
  const state::WorldDescription world = two_weights(m1, m2);
  const Scene at(world);
  // From the first weight (left) over the top to the second (right): clockwise about z.
  return {world,
          {rope(at, {node(BodyId(0), Vec3::Zero()), node({}, Vec3(0, 4, 0), radius, -1, efficiency),
                     node(BodyId(1), Vec3::Zero())})}};
}

TEST(Rope, AtwoodsMachineFallsAndPullsAsTheClosedFormSays) {
  const double m1 = 2, m2 = 3;
  Coupled scene = atwood(m1, m2, 0.2, 1);
  scene.run(0.5);
  const double a = (m2 - m1) / (m1 + m2) * kGravity;
  EXPECT_NEAR(scene.joint_at(1).velocity, -a * 0.5, 1e-4);
  EXPECT_NEAR(scene.joint_at(0).velocity, a * 0.5, 1e-4);
  EXPECT_NEAR(scene.coupling().force_n, 2 * m1 * m2 / (m1 + m2) * kGravity, 1e-3);
  EXPECT_NEAR(scene.coupling().length_m, 8 + kPi * 0.2, 1e-9) << "two parts of 4 m and half a turn";
  EXPECT_EQ(scene.coupling().slack_m, 0);
}

TEST(Rope, ASheavesEfficiencyIsTheRatioOfItsTensions) {
  const double m1 = 2, m2 = 3, eta = 0.9;
  Coupled scene = atwood(m1, m2, 0.2, eta);
  scene.run(0.5);
  // The rope runs to the second weight: T1 = eta T2, m2 g - T2 = m2 a, T1 - m1 g = m1 a.
  const double a = kGravity * (eta * m2 - m1) / (m1 + eta * m2);
  EXPECT_NEAR(scene.joint_at(0).velocity, a * 0.5, 1e-3);
  EXPECT_NEAR(scene.coupling().force_n / scene.coupling().end_force_n, eta, 1e-6);
}

TEST(Rope, ABrakedSheaveHoldsAnUnevenLoadAndDoesNotDriveIt) {
  Coupled scene = atwood(2.75, 3, 0.2, 0.9);  // 2.75 > 0.9 * 3
  scene.run(1);
  EXPECT_LT(std::abs(scene.joint_at(0).velocity), 1e-6);
  EXPECT_NEAR(scene.coupling().force_n, 2.75 * kGravity, 1e-3);
  EXPECT_NEAR(scene.coupling().end_force_n, 3 * kGravity, 1e-3);
}

TEST(Rope, ARopeRoundAPostHoldsByTheCapstanEquation) {
  const double mu = 0.3, ratio = std::exp(mu * kPi);
  for (const double share : {0.95, 1.05}) {
    const state::WorldDescription world = two_weights(1, share * ratio);
    const Scene at(world);
    state::Coupling over =
        rope(at, {node(BodyId(0), Vec3::Zero()), node({}, Vec3(0, 4, 0), 0.2, -1), node(BodyId(1), Vec3::Zero())});
    over.nodes[1].friction_coefficient = mu;
    Coupled scene(world, {over});
    scene.run(0.5);
    EXPECT_EQ(std::abs(scene.joint_at(0).velocity) > 0.02, share > 1) << share;
  }
}

/// A weight hangs on a moving sheave; one end of the rope is fastened above, the other comes off a drum over a fixed sheave.
struct Crane {
  static constexpr double kMass = 40, kInertia = 0.4, kDrum = 0.1;
  explicit Crane(double efficiency) {
    state::WorldDescription world = wheels({kInertia});
    world.bodies[1].X_WB.p = Vec3(2, 1, 0);
    world.joints[0].X_B1J.p = Vec3(2, 1, 0);
    add_weight(world, kMass, Vec3(0, 0, 0));
    const Scene at(world);
    state::RopeNode drum = node(BodyId(1), Vec3::Zero(), kDrum, 1);
    state::Coupling over;
    over.drum = true;
    over.joint1 = JointId(0);
    over.body1 = BodyId(0);
    const std::vector<state::RopeNode> nodes{drum, node({}, Vec3(0.3, 4, 0), 0.1, 1, efficiency),
                                             node(BodyId(2), Vec3(0, 0, 0), 0.1, -1, efficiency),
                                             node({}, Vec3(-0.1, 4, 0))};
    over.kind = state::CouplingKind::rope;
    for (const state::RopeNode& n : nodes)
      over.nodes[over.node_count++] = n;
    std::array<Pose, state::kMaxRopeNodes> X_WN;
    X_WN[0] = at.state->bodies[1].X_WB;
    X_WN[2] = at.state->bodies[2].X_WB;
    const state::RopePath path = state::measure_rope(over, X_WN, Quat::Identity());
    over.drum_start_1 = (path.p_out_W[0] - X_WN[0].p).normalized();
    over.offset = path.length_m;
    scene = std::make_unique<Coupled>(world, std::vector{over});
  }
  /// Which torque just lifts the weight: bisected by whether the drum, started gently, goes on.
  [[nodiscard]] static double lifting_torque(double efficiency) {
    double low = 0, high = 200;
    for (int i = 0; i < 16; ++i) {
      const double torque = 0.5 * (low + high);
      Crane crane(efficiency);
      for (int n = 0; n < 150; ++n) {
        crane.scene->joint_at(0).load = -torque;
        crane.scene->run(kStep);
      }
      (crane.scene->joint_at(1).velocity > 1e-4 ? high : low) = torque;
    }
    return 0.5 * (low + high);
  }
  std::unique_ptr<Coupled> scene;
};

TEST(Rope, AMovingSheaveHalvesTheForceAndDoublesTheRope) {
  EXPECT_NEAR(Crane::lifting_torque(1), Crane::kMass * kGravity * Crane::kDrum / 2,
              0.02 * Crane::kMass * kGravity * Crane::kDrum / 2);
  Crane crane(1);
  Coupled& scene = *crane.scene;
  const double length = scene.coupling().offset;
  while (scene.joint_at(0).position > -4 * kPi) {
    scene.joint_at(0).load = -20 - 5 * (2 + scene.joint_at(0).velocity);
    scene.run(kStep);
    ASSERT_LT(scene.state->bodies[2].X_WB.p.y(), 4);
  }
  const double wound = 4 * kPi * Crane::kDrum;
  EXPECT_NEAR(scene.joint_at(1).position, wound / 2, 0.02 * wound) << "half of what was wound";
  EXPECT_NEAR(length - scene.coupling().length_m, wound, 0.02 * wound);
  EXPECT_NEAR(scene.coupling().force_n, Crane::kMass * kGravity / 2, 0.1 * Crane::kMass * kGravity / 2);
}

TEST(Rope, EachSheaveCostsItsEfficiency) {
  // On the moving sheave two parts carry, of which the fastened one has eta times the other's tension; the fixed sheave costs another eta.
  const double eta = 0.9;
  const double tension = Crane::kMass * kGravity / (1 + eta) / eta;
  EXPECT_NEAR(Crane::lifting_torque(eta), tension * Crane::kDrum, 0.02 * tension * Crane::kDrum);
}

TEST(Rope, WindingADrumLiftsByItsRadiusTurnAfterTurn) {
  const double r = 0.15, I = 0.2, m = 10, M = 30;
  state::WorldDescription world = wheels({I});
  world.bodies[1].X_WB.p = world.joints[0].X_B1J.p = Vec3(0, 8, 0);
  add_weight(world, m, Vec3(r, 0, 0));
  const Scene at(world);
  state::Coupling over = rope(at, {node(BodyId(1), Vec3::Zero(), r, -1), node(BodyId(2), Vec3::Zero())});
  over.drum = true;
  over.joint1 = JointId(0);
  over.body1 = BodyId(0);
  over.drum_start_1 = Vec3::UnitX();
  over.offset = 8;
  Coupled scene(world, {over});
  for (int n = 0; n < 1000; ++n) {
    scene.joint_at(0).load = M;
    scene.run(kStep);
  }
  const double a = (M - m * kGravity * r) / (I + m * r * r);
  EXPECT_NEAR(scene.joint_at(0).velocity, a, 1e-3 * a);
  EXPECT_NEAR(scene.joint_at(1).velocity, r * a, 1e-3 * a);
  EXPECT_NEAR(scene.coupling().length_m, 8 - r * scene.joint_at(0).position, 1e-6);
  EXPECT_GT(scene.joint_at(0).position, 2 * kPi);
  scene.coupling().enabled = false;
  const double v = scene.joint_at(1).velocity;
  scene.run(0.2);
  EXPECT_NEAR(scene.joint_at(1).velocity, v - kGravity * 0.2, 1e-3) << "cut, it falls";
}

TEST(Rope, OnlyPulls) {
  state::WorldDescription world;
  world.bodies = {body("BALL", 1)};
  world.bodies[0].use_gravity = true;
  const Scene at(world);
  Coupled scene(world, {rope(at, {node({}, Vec3::Zero()), node(BodyId(0), Vec3::Zero())}, 1)});
  scene.run(0.3);
  EXPECT_NEAR(scene.at(0).V_WB.v.y(), -kGravity * 0.3, 1e-9) << "it falls freely while the rope is slack";
  EXPECT_NEAR(scene.coupling().slack_m, 1 + scene.at(0).X_WB.p.y(), 1e-9);
  EXPECT_EQ(scene.coupling().force_n, 0);
  scene.run(1);
  EXPECT_NEAR(scene.at(0).X_WB.p.y(), -1, 1e-3);
  EXPECT_NEAR(scene.coupling().force_n, kGravity, 1e-3) << "and then hangs";
}

TEST(Rope, APendulumSwingsOnItAndGainsNothing) {
  state::WorldDescription world;
  world.bodies = {body("BOB", 1)};
  world.bodies[0].use_gravity = true;
  world.bodies[0].X_WB.p = Vec3(std::sin(1.0), -std::cos(1.0), 0);
  const Scene at(world);
  Coupled scene(world, {rope(at, {node({}, Vec3::Zero()), node(BodyId(0), Vec3::Zero())})});
  const double start = energy_of(scene), depth = kGravity * (1 - std::cos(1.0));
  double most_x = -1;
  for (int n = 0; n < 10000; ++n) {
    scene.run(kStep);
    ASSERT_LE(energy_of(scene), start + 0.01 * depth) << n;
    ASSERT_NEAR(scene.at(0).X_WB.p.norm(), 1, 1e-3);
    if (n > 8000) most_x = std::max(most_x, scene.at(0).X_WB.p.x());
  }
  EXPECT_GT(most_x, 0.5) << "it still swings";
}

TEST(RopePath, GoesRoundSheavesByTheirTangents) {
  state::Coupling belt;
  belt.kind = state::CouplingKind::rope;
  for (const state::RopeNode& n : {node({}, Vec3(-1, 0, 0)), node({}, Vec3(0, 0, 0), 0.3, -1),
                                   node({}, Vec3(2, 0, 0), 0.5, 1), node({}, Vec3(3, 1, 0))})
    belt.nodes[belt.node_count++] = n;
  const state::RopePath path = state::measure_rope(belt, {}, Quat::Identity());
  for (const std::size_t i : {1u, 2u}) {
    const Vec3 c = belt.nodes[i].p_BC;
    EXPECT_NEAR((path.p_in_W[i] - c).norm(), belt.nodes[i].radius_m, 1e-9);
    EXPECT_NEAR((path.p_in_W[i] - path.p_out_W[i - 1]).dot(path.p_in_W[i] - c), 0, 1e-9);
    EXPECT_NEAR((path.p_in_W[i + 1] - path.p_out_W[i]).dot(path.p_out_W[i] - c), 0, 1e-9);
  }
  // The inner tangent of two circles at a distance d is sqrt(d^2 - (r1 + r2)^2) long.
  EXPECT_NEAR((path.p_in_W[2] - path.p_out_W[1]).norm(), std::sqrt(4 - 0.64), 1e-9);
  EXPECT_GT(path.p_in_W[1].y(), 0) << "over the first";
  EXPECT_LT(path.p_in_W[2].y(), 0) << "under the second";
}

}  // namespace
}  // namespace mechane::dynamics::test
