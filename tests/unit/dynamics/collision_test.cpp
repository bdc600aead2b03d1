// Bodies against each other: they rest, stack, slide, bounce, and do not go through.
#include <array>
#include <cmath>

#include "server/state/world_state.hpp"
#include "tests/support/error_like.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/dynamics/blocks.hpp"

namespace mechane::dynamics::test {
namespace {

const Vec3 kBlockHalf_m(0.05, 0.03, 0.04);

Pose at(double x, double y, double z, const Vec3& turn = Vec3::Zero()) {
  return {Vec3(x, y, z), quat_from_rotation_vector(turn)};
}

/// The lowest of a block's corners.
double lowest_m(const Pose& X_WB, const Vec3& half_m) {
  return X_WB.p.y() - (X_WB.R.toRotationMatrix().row(1).transpose().cwiseAbs().dot(half_m));
}

TEST(Collision, ADroppedBlockComesToRestOnTheTableAndStays) {
  Scene scene(world_of({table(), block("BLOCK", kBlockHalf_m, at(0.013, 0.08, 0.007, {0.2, 0.3, 0.1}))}));
  scene.run(2);
  const state::BodyState rest = scene.at(1);
  EXPECT_NEAR(lowest_m(rest.X_WB, kBlockHalf_m), 0, 1e-3);
  EXPECT_NEAR(rest.X_WB.p.y(), kBlockHalf_m.y(), 1e-3) << "flat on its side";
  EXPECT_LT(rest.V_WB.v.norm(), 1e-3) << "what the solver leaves";
  EXPECT_LT(rest.V_WB.w.norm(), 1e-2);
  scene.run(5);
  EXPECT_LT((scene.at(1).X_WB.p - rest.X_WB.p).norm(), 1e-6) << "no creep at all";
  EXPECT_LT(scene.at(1).X_WB.R.angularDistance(rest.X_WB.R), 1e-6);
}

TEST(Collision, AStackOfThreeStands) {
  MECHANE_NOT_UNDER_ADDRESS_SANITIZER("thousands of ticks");
  const std::array<Pose, 3> places{at(0, 0.03, 0), at(0.01, 0.09, 0.005, {0, 0.3, 0}),
                                   at(0, 0.15, -0.005, {0, -0.2, 0})};
  Scene scene(world_of({table(), block("LOW", kBlockHalf_m, places[0]), block("MIDDLE", kBlockHalf_m, places[1]),
                        block("HIGH", kBlockHalf_m, places[2])}));
  scene.run(5);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((scene.at(i + 1).X_WB.p - places[i].p).norm(), 1e-3) << i;
    EXPECT_LT(scene.at(i + 1).X_WB.R.angularDistance(places[i].R), 5e-3) << i;
    EXPECT_LT(scene.at(i + 1).V_WB.v.norm(), 1e-3) << i;
  }
}

/// How far down a slope a block gets in `seconds` that starts at rest.
double slides_m(double slope_rad, double static_friction, double dynamic_friction, double seconds) {
  state::BodyDescription plane = table(slope_rad);
  const Quat R = plane.X_WB.R;
  state::BodyDescription load = block("BLOCK", kBlockHalf_m, {R * Vec3(0.2, kBlockHalf_m.y() - 1e-4, 0), R});
  for (state::BodyDescription* one : {&plane, &load}) {
    one->haptic.static_friction = static_friction;
    one->haptic.dynamic_friction = dynamic_friction;
  }
  Scene scene(world_of({plane, load}));
  scene.run(seconds);
  const Vec3 p_slope = R.conjugate() * scene.at(1).X_WB.p;
  EXPECT_NEAR(p_slope.y(), kBlockHalf_m.y(), 1e-3);
  EXPECT_NEAR(p_slope.z(), 0, 1e-3);
  return 0.2 - p_slope.x();
}

TEST(Collision, ASlopeHoldsABlockBelowTheFrictionAngleAlone) {
  const double slope = std::atan(0.5);
  EXPECT_LT(std::abs(slides_m(slope, 0.53, 0.3, 2)), 2e-4);
  const double acceleration = 9.81 * (std::sin(slope) - 0.3 * std::cos(slope));
  EXPECT_NEAR(slides_m(slope, 0.47, 0.3, 0.5), acceleration * 0.5 * 0.5 / 2, 0.03 * acceleration * 0.125)
      << "once it slips it has its dynamic friction";
}

TEST(Collision, WhatIsThrownAtAThinPlateDoesNotGoThrough) {
  const Vec3 plate_half(0.1, 0.0025, 0.1);
  state::BodyDescription plate = block("PLATE", plate_half, at(0, -plate_half.y(), 0));
  plate.fixed = true;
  const Vec3 half(0.02, 0.015, 0.025);
  for (const Vec3& turn : {Vec3(0, 0.2, 0), Vec3(0.6, 0, 0.8), Vec3(0, 0, kPi / 4), Vec3(0.1, 0.3, 0)}) {
    for (int phase = 0; phase < 5; ++phase) {  // where between two steps it meets the plate
      Scene scene(world_of({plate, block("BLOCK", half, at(0.01, 0, 0.02, turn))}));
      scene.at(1).X_WB.p.y() -= lowest_m(scene.at(1).X_WB, half) - 0.01 - 4e-4 * phase;
      scene.at(1).V_WB.v = Vec3(0.3, -2, 0);
      for (int n = 0; n < 300; ++n) {
        scene.run(kStep);
        const Pose& X_WB = scene.at(1).X_WB;
        const bool beside = X_WB.p.cwiseAbs().maxCoeff() > 0.06;
        ASSERT_TRUE(beside || lowest_m(X_WB, half) > -2.5e-3) << turn.transpose() << ", tick " << n;
      }
    }
  }
}

/// Two blocks in empty space that fly at each other.
Scene meeting(const Pose& X_WA, const Pose& X_WB, const Vec3& v_A, const Vec3& v_B, double restitution) {
  state::WorldDescription world =
      world_of({block("A", kBlockHalf_m, X_WA), block("B", Vec3(0.02, 0.015, 0.025), X_WB)});
  for (state::BodyDescription& one : world.bodies) {
    one.use_gravity = false;
    one.restitution = restitution;
  }
  Scene scene(world);
  scene.at(0).V_WB.v = v_A;
  scene.at(1).V_WB.v = v_B;
  return scene;
}

struct Motion {
  Vec3 momentum = Vec3::Zero();
  Vec3 spin = Vec3::Zero();  // angular momentum about the origin
  double energy = 0;
};

Motion motion_of(Scene& scene) {
  Motion out;
  for (std::size_t i = 0; i < 2; ++i) {
    const state::BodyDescription& what = scene.description.bodies[i];
    const state::BodyState& now = scene.at(i);
    const Mat3 R(now.X_WB.R);
    const Vec3 p = what.mass_kg * now.V_WB.v;
    const Vec3 own = R * what.inertia_kg_m2 * R.transpose() * now.V_WB.w;
    out.momentum += p;
    out.spin += now.X_WB.p.cross(p) + own;
    out.energy += 0.5 * p.dot(now.V_WB.v) + 0.5 * own.dot(now.V_WB.w);
  }
  return out;
}

TEST(Collision, KeepsMomentumAndSpin) {
  for (const double restitution : {0.0, 0.6}) {
    Scene scene = meeting(at(-0.08, 0.01, 0, {0.3, 0.2, 0.5}), at(0.06, 0, 0.01, {0.1, 0.7, 0}), {0.5, 0, 0.05},
                          {-1.1, 0.1, 0}, restitution);
    const Motion before = motion_of(scene);
    scene.run(0.2);
    const Motion after = motion_of(scene);
    EXPECT_GT((scene.at(1).V_WB.v - Vec3(-1.1, 0.1, 0)).norm(), 0.3) << "they must have met";
    EXPECT_LT((after.momentum - before.momentum).norm(), 1e-12);
    EXPECT_LT((after.spin - before.spin).norm(), 2e-3 * before.spin.norm() + 2e-5);
    EXPECT_LT(after.energy, before.energy);
  }
}

TEST(Collision, RestitutionGivesTheSpeedBack) {
  for (const double restitution : {0.0, 0.5, 1.0}) {
    Scene scene = meeting(at(-0.08, 0, 0), at(0.03, 0, 0), {0.6, 0, 0}, {-0.6, 0, 0}, restitution);
    scene.run(0.2);
    const double apart = scene.at(1).V_WB.v.x() - scene.at(0).V_WB.v.x();
    EXPECT_NEAR(apart, restitution * 1.2, 0.012) << restitution;
  }
}

// Whoever may not touch moves as in a world in which nobody collides, to the bit.

/// Two bodies that overlap, one of them free; whether they collide, and what else is so of them.
template <class Change>
std::uint64_t hash_after(bool collide, const Change& change) {
  state::WorldDescription world =
      world_of({table(), block("BLOCK", kBlockHalf_m, at(0.01, 0.02, 0.01, {0.1, 0.2, 0.3}))});
  for (state::BodyDescription& one : world.bodies)
    one.collides = collide;
  const state::JointDescription tie = joint(state::JointKind::ball, at(0, 0.02, 0), at(0, -0.02, 0));
  change(world, tie);
  Scene scene(world);
  change(*scene.state);
  scene.run(0.1);
  EXPECT_GT((scene.at(1).X_WB.p - world.bodies[1].X_WB.p).norm(), 1e-4) << "something must happen";
  return state::state_hash(*scene.state);
}

struct NoChange {
  void operator()(state::WorldDescription& /*world*/, const state::JointDescription& /*tie*/) const {}
  void operator()(state::WorldState& /*state*/) const {}
};

TEST(NoCollision, ButForThisTheyWouldMeet) {
  EXPECT_NE(hash_after(true, NoChange{}), hash_after(false, NoChange{}));
}

TEST(NoCollision, OfOneThatDidNotOptIn) {
  struct : NoChange {
    using NoChange::operator();
    void operator()(state::WorldDescription& world, const state::JointDescription& /*tie*/) const {
      world.bodies[0].collides = false;
    }
  } alone;
  EXPECT_EQ(hash_after(true, alone), hash_after(false, alone));
}

TEST(NoCollision, OfWhatAJointTiesOnOrOff) {
  for (const bool on : {true, false}) {
    struct Tied : NoChange {
      using NoChange::operator();
      bool on = true;
      void operator()(state::WorldDescription& world, const state::JointDescription& tie) const {
        world.joints = {tie};
        world.joints[0].enabled_at_start = on;
      }
    } tied;
    tied.on = on;
    EXPECT_EQ(hash_after(true, tied), hash_after(false, tied));
  }
}

TEST(NoCollision, OfMates) {
  struct : NoChange {
    using NoChange::operator();
    void operator()(state::WorldDescription& world, const state::JointDescription& /*tie*/) const {
      world.mates = {{BodyId(1), BodyId(0)}};
    }
  } mated;
  EXPECT_EQ(hash_after(true, mated), hash_after(false, mated));
}

TEST(NoCollision, OfWhatIsHidden) {
  struct : NoChange {
    using NoChange::operator();
    void operator()(state::WorldState& state) const { state.bodies[0].visible = false; }
  } hidden;
  EXPECT_EQ(hash_after(true, hidden), hash_after(false, hidden));
}

TEST(NoCollision, OfTwoBodiesInHandsButOfOneAlone) {
  const auto distance_after = [](bool both) {
    state::WorldDescription world =
        world_of({block("LEFT", kBlockHalf_m, at(-0.048, 0, 0)), block("RIGHT", kBlockHalf_m, at(0.048, 0, 0))});
    for (state::BodyDescription& one : world.bodies)
      one.use_gravity = false;
    Scene scene(world);
    if (both) hold(scene, 1, Vec3::Zero(), 20, 1);
    std::swap(scene.state->users[0], scene.state->users[1]);
    hold(scene, 0, Vec3::Zero(), 20, 1);
    scene.run(0.5);
    return (scene.at(1).X_WB.p - scene.at(0).X_WB.p).norm();
  };
  EXPECT_NEAR(distance_after(true), 0.096, 1e-6);
  EXPECT_GT(distance_after(false), 0.0995) << "out, and on by the hand's spring";
}

TEST(CollisionCreate, RefusesWhatCannotCollide) {
  using mechane::test::is_error;
  const auto error_of = [](const state::WorldDescription& world) {
    const state::WorldState state(world);
    auto made = DynamicsWorld::create(world, state);
    return made ? Error{} : made.error();
  };
  const state::WorldDescription good = world_of({table(), block("BLOCK", kBlockHalf_m, at(0, 1, 0))});
  EXPECT_EQ(error_of(good).what, "");
  state::WorldDescription world = good;
  world.bodies[1].object = nullptr;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, 0, {"body BLOCK"}));
  world = good;
  world.bodies[1].restitution = 1.5;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, 0, {"body BLOCK", "restitution", "1.5"}));
  world = good;
  world.bodies[1].haptic.static_friction = std::nan("");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, 0, {"body BLOCK", "friction"}));
  world = good;
  world.bodies.resize(200, good.bodies[1]);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::too_large, 0, {"200", "at most 128"}));
}

}  // namespace
}  // namespace mechane::dynamics::test
