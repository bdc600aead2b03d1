#include "server/haptics/render_forces.hpp"

#include <gtest/gtest.h>

#include "server/haptics/effective_mass.hpp"
#include "tests/support/crank_world.hpp"

namespace mechane::haptics {
namespace {

using state::Contact;
using state::WorldDescription;
using state::WorldState;

WorldDescription one_body(bool fixed) {
  WorldDescription world;
  state::BodyDescription body;
  body.name = "BLOCK";
  body.fixed = fixed;
  body.mass_kg = 2;
  body.inertia_kg_m2 = Vec3(0.1, 0.1, 0.1).asDiagonal();
  world.bodies = {body};
  return world;
}

Contact touch(double depth_m, std::uint8_t segment = 0) {
  Contact c;
  c.body = BodyId(0);
  c.segment = segment;
  c.n_BH_W = Vec3::UnitY();
  c.depth_m = depth_m;
  return c;
}

/// A user who has been there long enough for the ramp to be over.
class Bench {
 public:
  Bench(const WorldDescription& world, ForceConfig config)
      : world_(world), state_(world), renderer_(ForceRenderer::create(config).value()) {
    renderer_.start(state_);
    state_.users[0].present = true;
    state_.users[0].freshness = 1;
    for (int i = 0; i < 2000; ++i)
      run();
  }
  void run() {
    for (auto& body : state_.bodies)
      body.load_W = Wrench{};
    renderer_.run(world_, *test::shared_hand(), state_);
  }
  state::UserState& user() { return state_.users[0]; }
  state::WorldState& state() { return state_; }

  /// The force when it has settled.
  Vec3 settle() {
    for (int i = 0; i < 200; ++i)
      run();
    return user().output.force_W.f;
  }

 private:
  const WorldDescription& world_;
  WorldState state_;
  ForceRenderer renderer_;
};

ForceConfig plain() {
  ForceConfig config;
  config.governor.passivity = false;
  return config;
}

TEST(RenderForces, ATouchIsASpringAndTheBodyGetsTheOpposite) {
  const WorldDescription world = one_body(false);
  Bench bench(world, plain());
  bench.user().contacts[0] = touch(0.003);
  bench.user().contact_count = 1;
  const Vec3 f = bench.settle();
  EXPECT_NEAR(f.y(), 600 * 0.003, 1e-9);
  EXPECT_NEAR(bench.state().bodies[0].load_W.f.y(), -f.y(), 1e-9);
  EXPECT_EQ(bench.user().output.contact_count, 1u);
}

TEST(RenderForces, AHandThatFellSilentHasNoForceAndNoContacts) {
  const WorldDescription world = one_body(false);
  Bench bench(world, plain());
  bench.user().contacts[0] = touch(0.003);
  bench.user().contact_count = 1;
  ASSERT_GT(bench.settle().norm(), 1);
  bench.user().age = hand::kZeroBy;
  bench.user().freshness = 0;
  EXPECT_EQ(bench.settle().norm(), 0);
  EXPECT_EQ(bench.user().output.contact_count, 0u) << "a client must not render them either";
}

TEST(RenderForces, AHandThatFellSilentHasNoPathOfWhatItHolds) {
  const auto crank = test::make_crank_description();
  Bench bench(*crank, plain());
  bench.state().joints[0].enabled = true;
  state::Grasp& grasp = bench.user().grasp;
  grasp.active = true;
  grasp.body = BodyId(1);
  grasp.p_BG = Vec3(test::kCrankRadiusM, 0, 0);
  bench.run();
  EXPECT_EQ(bench.user().output.held.kind, hand::HeldPath::Kind::circle);
  bench.user().freshness = 0;
  bench.run();
  EXPECT_EQ(bench.user().output.held.kind, hand::HeldPath::Kind::none);
}

TEST(RenderForces, NeverOverTheLimit) {
  const WorldDescription world = one_body(true);
  Bench bench(world, plain());
  bench.user().contacts[0] = touch(0.5);
  bench.user().contact_count = 1;
  EXPECT_LE(bench.settle().norm(), plain().governor.max_force_n + 1e-12);
  EXPECT_NE(bench.user().output.reasons & hand::kClamped, 0u);
}

TEST(RenderForces, PaperModeHalvesWhereContinuousDoesNot) {
  const WorldDescription world = one_body(true);
  for (const ForceMode mode : {ForceMode::continuous, ForceMode::paper}) {
    ForceConfig config = plain();
    config.mode = mode;
    Bench bench(world, config);
    bench.user().contacts[0] = touch(0.004);
    bench.user().contact_count = 1;
    const double alone = bench.settle().y();
    bench.user().contacts[1] = touch(1e-9);
    bench.user().contact_count = 2;
    const double with_touch = bench.settle().y();
    const double expected = mode == ForceMode::paper ? 0.5 : 1.0;
    EXPECT_NEAR(with_touch / alone, expected, 1e-3);
  }
}

TEST(RenderForces, DampingActsOnlyOnTheWayIn) {
  const WorldDescription world = one_body(true);
  Bench bench(world, plain());
  bench.user().contacts[0] = touch(0.003);
  bench.user().contact_count = 1;
  const double still = bench.settle().y();
  bench.user().V_WH.v = Vec3(0, -0.2, 0);
  const double pushing = bench.settle().y();
  bench.user().V_WH.v = Vec3(0, 0.2, 0);
  const double leaving = bench.settle().y();
  EXPECT_NEAR(pushing - still, 1.5 * 0.2, 1e-6);
  EXPECT_NEAR(leaving, still, 1e-9);
}

TEST(RenderForces, AGlovesFingerFeelsOnlyWhatPushesItOpen) {
  const WorldDescription world = one_body(true);
  Bench bench(world, plain());
  bench.user().sample.kind = hand::HandKind::glove;
  for (auto& X_WS : bench.user().X_WS)
    X_WS = Pose{};
  bench.user().contacts[0] = touch(0.002, 6);
  bench.user().contact_count = 1;
  (void)bench.settle();
  EXPECT_NEAR(bench.user().output.finger_force_n[1], 1.2, 1e-6);
  EXPECT_EQ(bench.user().output.finger_force_n[0], 0);
  bench.user().contacts[0].n_BH_W = -Vec3::UnitY();
  (void)bench.settle();
  EXPECT_EQ(bench.user().output.finger_force_n[1], 0) << "a glove that only pulls cannot push a finger closed";
}

TEST(EffectiveMass, IsTheMassThroughTheCentreAndLessBesideIt) {
  const WorldDescription world = one_body(false);
  const WorldState state(world);
  EXPECT_NEAR(effective_mass_kg(world, state, BodyId(0), Vec3::Zero(), Vec3::UnitY()), 2, 1e-12);
  EXPECT_LT(effective_mass_kg(world, state, BodyId(0), Vec3(0.3, 0, 0), Vec3::UnitY()), 2);
}

TEST(EffectiveMass, ThroughAHingeIsInertiaOverLeverSquared) {
  WorldDescription world = one_body(false);
  world.bodies.push_back(one_body(true).bodies[0]);
  state::JointDescription hinge;
  hinge.body1 = BodyId(1);
  hinge.body2 = BodyId(0);
  world.joints = {hinge};
  const WorldState state(world);
  EXPECT_NEAR(effective_mass_kg(world, state, BodyId(0), Vec3(0.25, 0, 0), Vec3::UnitY()), 0.1 / (0.25 * 0.25), 1e-9);
  EXPECT_TRUE(std::isinf(effective_mass_kg(world, state, BodyId(0), Vec3(0.25, 0, 0), Vec3::UnitX())));
}

}  // namespace
}  // namespace mechane::haptics
