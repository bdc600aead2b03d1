#include "server/haptics/held_path.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "tests/support/crank_world.hpp"

namespace mechane::haptics {
namespace {

using hand::HeldPath;
using state::JointKind;
using state::WorldDescription;
using state::WorldState;

/// The path of a hand at the handle, pulled by 1, 2 and 3 N along W's axes. The hand's frame is the handle's place, turned a quarter.
HeldPath path_of(const WorldDescription& world, const std::function<void(WorldState&)>& change = {}) {
  WorldState state(world);
  state.joints[0].enabled = true;
  state::UserState& user = state.users[0];
  user.grasp.active = true;
  user.grasp.body = BodyId(1);
  user.grasp.p_BG = Vec3(test::kCrankRadiusM, 0, 0.01);
  user.grasp.X_HB = Pose{Vec3(0, 0, 0.05), quat_from_rotation_vector(Vec3(0, 0, kPi / 2))};
  user.grasp.force_limit_n = 6;
  user.grasp.reaction_W.f = Vec3(1, 2, 3);
  if (change) change(state);
  return held_path(world, state, user);
}

TEST(HeldPath, OfACrankIsACircleAboutItsAxle) {
  const auto world = test::make_crank_description();
  const HeldPath path = path_of(*world);
  ASSERT_EQ(path.kind, HeldPath::Kind::circle);
  EXPECT_LT((path.axis_W - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((path.p_W - Vec3(0, 0, 0.01)).norm(), 1e-12);
  EXPECT_NEAR(path.radius_m, test::kCrankRadiusM, 1e-12);
  EXPECT_NEAR(path.along_n, 2, 1e-12);
  EXPECT_LT((path.p_HG - Vec3(0, test::kCrankRadiusM, 0.06)).norm(), 1e-12);
  EXPECT_EQ(path.stiffness_n_per_m, 600);
  EXPECT_EQ(path.damping_ns_per_m, world->bodies[1].haptic.damping_ns_per_m);
  EXPECT_EQ(path.limit_n, 6);
}

TEST(HeldPath, OfASliderIsALineThroughTheGrip) {
  auto world = test::make_crank_description();
  world->joints[0].kind = JointKind::slider;
  world->joints[0].X_B1J.R = quat_from_rotation_vector(Vec3(0, -kPi / 2, 0));  // x becomes z
  const HeldPath path = path_of(*world);
  ASSERT_EQ(path.kind, HeldPath::Kind::line);
  EXPECT_LT((path.axis_W - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_LT((path.p_W - Vec3(test::kCrankRadiusM, 0, 0.01)).norm(), 1e-12);
  EXPECT_NEAR(path.along_n, 3, 1e-12);
}

TEST(HeldPath, IsNoneOfWhatMovesOtherwise) {
  const auto crank = test::make_crank_description();
  const auto none = [](const WorldDescription& world, const std::function<void(WorldState&)>& change = {}) {
    return path_of(world, change).kind == HeldPath::Kind::none;
  };
  EXPECT_TRUE(none(*crank, [](WorldState& state) { state.users[0].grasp.active = false; }));
  EXPECT_TRUE(none(*crank, [](WorldState& state) { state.joints[0].enabled = false; })) << "free, and without weight";
  EXPECT_TRUE(none(*crank, [](WorldState& state) { state.bodies[1].movable = false; }));
  EXPECT_TRUE(none(*crank, [](WorldState& state) { state.joints[0].pitch_m_per_rad = 0.01; })) << "a screw";
  EXPECT_TRUE(none(*crank, [](WorldState& state) { state.users[0].grasp.p_BG.x() = 0.019; })) << "held at its axle";

  auto changed = test::make_crank_description();
  changed->bodies[0].fixed = false;
  EXPECT_TRUE(none(*changed)) << "on something that moves itself";
  EXPECT_TRUE(none(*changed, [](WorldState& state) { state.bodies[0].movable = false; })) << "or that is moved";
  changed = test::make_crank_description();
  changed->joints[0].kind = JointKind::ball;
  EXPECT_TRUE(none(*changed));
  changed = test::make_crank_description();
  changed->joints.push_back(changed->joints[0]);
  EXPECT_TRUE(none(*changed, [](WorldState& state) { state.joints[1].enabled = true; })) << "two joints";
  EXPECT_FALSE(none(*changed, [](WorldState& state) { state.joints[1].enabled = false; }));
}

/// The crank on no axle, of 2 kg of which an eighth is felt, and of which the middle is off its origin.
std::shared_ptr<WorldDescription> loose_crank() {
  auto world = test::make_crank_description();
  world->bodies[1].use_gravity = true;
  world->bodies[1].effort_scale = 0.125;
  world->bodies[1].p_BCm = Vec3(0.1, 0, 0);
  return world;
}
void take_off(WorldState& state) {
  state.joints[0].enabled = false;
}

TEST(HeldPath, OfACarriedBodyIsItsWeight) {
  const HeldPath path = path_of(*loose_crank(), take_off);
  ASSERT_EQ(path.kind, HeldPath::Kind::free);
  EXPECT_EQ(path.axis_W, Vec3(0, -1, 0));
  EXPECT_NEAR(path.along_n, 0.25 * 9.81, 1e-12);
  EXPECT_LT((path.p_HG - Vec3(0, 0.1, 0.05)).norm(), 1e-12);
  auto heavy = loose_crank();
  heavy->bodies[1].effort_scale = 1;
  EXPECT_EQ(path_of(*heavy, take_off).along_n, 6) << "no more than the grip bears";
}

TEST(HeldPath, IsNoWeightWhereSomethingElseMayBearIt) {
  const auto none = [](const WorldDescription& world, const std::function<void(WorldState&)>& change = {}) {
    return path_of(world, [&](WorldState& state) {
             take_off(state);
             if (change) change(state);
           }).kind == HeldPath::Kind::none;
  };
  auto changed = loose_crank();
  changed->bodies[1].collides = true;
  EXPECT_TRUE(none(*changed)) << "it may lie on a body";
  changed = loose_crank();
  changed->joints[0].body1 = BodyId(1);
  changed->joints[0].body2 = BodyId(0);
  EXPECT_TRUE(none(*changed, [](WorldState& state) { state.joints[0].enabled = true; })) << "it bears another";
  changed = loose_crank();
  EXPECT_TRUE(none(*changed, [](WorldState& state) { state.users[1].grasp = state.users[0].grasp; })) << "two hands";
  state::Coupling rope;
  rope.kind = state::CouplingKind::rope;
  rope.node_count = 2;
  rope.enabled = true;
  rope.nodes[1].body = BodyId(1);
  EXPECT_TRUE(none(*changed, [&](WorldState& state) { state.couplings.push_back(rope); }));
  rope.enabled = false;
  EXPECT_FALSE(none(*changed, [&](WorldState& state) { state.couplings.push_back(rope); }));
}

}  // namespace
}  // namespace mechane::haptics
