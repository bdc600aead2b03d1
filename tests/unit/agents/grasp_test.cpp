#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using hand::HandKind;
using state::EventKind;

const BodyId kPart(1);
const BodyId kCrank(2);

state::WorldDescription with_grasp() {
  state::WorldDescription world = stage_world();
  world.agents = {{"GRASP",
                   "simulation.grasp",
                   {{"bodies", text({"PART", "CRANK"})}, {"forceLimit", number({6})}, {"torqueLimit", number({0.3})}},
                   5}};
  return world;
}

/// A one-point hand at PART that closes while it touches.
Stage holding_part() {
  Stage stage(with_grasp());
  stage.appear(0, HandKind::one_point, Vec3(1, 0, 0.02));
  stage.touch(0, kPart, 0, Vec3::UnitZ(), Vec3(1, 0, 0.01));
  stage.tick();
  stage.user().sample.grasp_intent = 1;
  stage.run(0.03);
  EXPECT_TRUE(stage.user().grasp.active);
  return stage;
}

TEST(Grasp, ByIntentInContactTakesHoldWhereTheHandIs) {
  const Stage stage = holding_part();
  const state::Grasp& grasp = stage.user().grasp;
  EXPECT_EQ(grasp.body, kPart);
  EXPECT_EQ(grasp.force_limit_n, 6);
  EXPECT_EQ(grasp.torque_limit_nm, 0.3);
  EXPECT_LT(((stage.user().X_WH * grasp.X_HB).p - Vec3(1, 0, 0)).norm(), 1e-12) << "the body does not jump";
  EXPECT_LT((grasp.p_BG - Vec3(0, 0, 0.01)).norm(), 1e-12) << "the grip is at the contact";
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::grasped, &event), 1);
  EXPECT_EQ(event.subject, 0u);
  EXPECT_EQ(event.object, 1u);
  EXPECT_EQ(stage.value("GRASP.active"), 1);
  EXPECT_EQ(stage.value("GRASP.body"), 1);
}

TEST(Grasp, NeedsContactAndTime) {
  Stage stage(with_grasp());
  stage.appear(0, HandKind::one_point);
  stage.tick();
  stage.user().sample.grasp_intent = 1;
  stage.run(1);
  EXPECT_FALSE(stage.user().grasp.active) << "the hand closes in the air";
  stage.touch(0, kPart, 0, Vec3::UnitX());
  stage.run(0.015);
  EXPECT_FALSE(stage.user().grasp.active) << "not for long enough";
  stage.run(0.01);
  EXPECT_TRUE(stage.user().grasp.active);
}

TEST(Grasp, OfTheFrameOrOfWhatMayNotBeGraspedIsNone) {
  Stage stage(with_grasp());
  stage.appear(0, HandKind::one_point);
  stage.touch(0, BodyId(0), 0, Vec3::UnitX());
  stage.touch(0, kPart, 0, Vec3::UnitX());
  stage.state->bodies[1].graspable = false;
  stage.tick();
  stage.user().sample.grasp_intent = 1;
  stage.run(0.1);
  EXPECT_FALSE(stage.user().grasp.active);
  stage.state->bodies[1].graspable = true;
  stage.state->bodies[1].movable = false;
  stage.run(0.1);
  EXPECT_FALSE(stage.user().grasp.active);
}

RC_GTEST_PROP(Grasp, AGloveHoldsWhenThumbAndFingerAreOpposed, ()) {
  Stage stage(with_grasp());
  stage.appear(0, HandKind::glove);
  const auto thumb = static_cast<std::uint8_t>(*rc::gen::inRange(1, 4));
  const auto other = static_cast<std::uint8_t>(*rc::gen::inRange(0, 16));
  const double angle = 0.01 * *rc::gen::inRange(0, 314);
  RC_PRE(std::abs(std::cos(angle) + 0.3) > 0.01);
  stage.touch(0, kPart, thumb, Vec3::UnitX(), Vec3(1.02, 0, 0));
  stage.touch(0, kPart, other, Vec3(std::cos(angle), std::sin(angle), 0), Vec3(0.98, 0, 0));
  stage.run(0.05);
  const bool finger = other >= 4;
  RC_ASSERT(stage.user().grasp.active == (finger && std::cos(angle) < -0.3));
  if (stage.user().grasp.active) RC_ASSERT(stage.user().grasp.p_BG.norm() < 1e-12);
}

TEST(Grasp, AnAgentThatIsOffLeavesAnothersGraspAlone) {
  state::WorldDescription world = with_grasp();
  world.agents.push_back({"OTHER", "simulation.grasp", {{"bodies", text({"PART"})}, {"torqueLimit", number({2})}}, 6});
  Stage stage(std::move(world));
  stage.state->agent_enabled[0] = 0;
  stage.appear(0, HandKind::one_point);
  stage.touch(0, kPart, 0, Vec3::UnitX());
  stage.tick();
  stage.user().sample.grasp_intent = 1;
  stage.run(0.1);
  ASSERT_TRUE(stage.user().grasp.active);
  EXPECT_EQ(stage.user().grasp.torque_limit_nm, 2);
  EXPECT_EQ(stage.count(EventKind::grasped), 1);
  EXPECT_EQ(stage.value("GRASP.active"), 0);
  EXPECT_EQ(stage.value("OTHER.active"), 1);
  stage.state->agent_enabled[0] = 1;
  stage.state->agent_enabled[1] = 0;
  stage.run(0.1);
  EXPECT_FALSE(stage.user().grasp.active) << "nor does it take the body over from a hand that never opened";
}

TEST(Grasp, OpposedFingersOnTwoBodiesHoldNeither) {
  Stage stage(with_grasp());
  stage.appear(0, HandKind::glove);
  stage.touch(0, kPart, 2, Vec3::UnitX());
  stage.touch(0, kCrank, 5, -Vec3::UnitX());
  stage.run(0.1);
  EXPECT_FALSE(stage.user().grasp.active);
}

TEST(Grasp, EndsWhenTheHandOpens) {
  Stage stage = holding_part();
  stage.lift_off();
  stage.user().sample.grasp_intent = 0.35;
  stage.run(0.2);
  EXPECT_TRUE(stage.user().grasp.active) << "between closing and opening nothing changes";
  stage.user().sample.grasp_intent = 0.1;
  stage.run(0.03);
  EXPECT_FALSE(stage.user().grasp.active);
  EXPECT_EQ(stage.count(EventKind::released), 1);
  EXPECT_EQ(stage.value("GRASP.active"), 0);
  EXPECT_EQ(stage.value("GRASP.body"), -1);
}

TEST(Grasp, WhatIsTakenOutOfTheHandIsNotTakenBackWithoutOpening) {
  Stage stage = holding_part();
  stage.state->bodies[1].graspable = false;
  stage.tick();
  EXPECT_FALSE(stage.user().grasp.active);
  stage.state->bodies[1].graspable = true;
  stage.run(0.5);
  EXPECT_FALSE(stage.user().grasp.active) << "the hand is still closed";
  stage.user().sample.grasp_intent = 0;
  stage.tick();
  stage.user().sample.grasp_intent = 1;
  stage.run(0.05);
  EXPECT_TRUE(stage.user().grasp.active);
}

TEST(Grasp, BreaksWhenTheBodyLagsTooFarBehind) {
  Stage stage = holding_part();
  stage.user().X_WH.p.x() += 0.07;
  stage.tick();
  EXPECT_TRUE(stage.user().grasp.active);
  stage.user().X_WH.p.x() += 0.02;
  stage.tick();
  EXPECT_FALSE(stage.user().grasp.active);
}

TEST(Grasp, EndsWhenSamplesStopAndComesBackWithThem) {
  Stage stage = holding_part();
  stage.user().freshness = 0.4;
  stage.run(0.05);
  EXPECT_TRUE(stage.user().grasp.active) << "the force decays first";
  stage.user().freshness = 0;
  stage.tick();
  EXPECT_FALSE(stage.user().grasp.active);
  stage.run(0.1);
  EXPECT_FALSE(stage.user().grasp.active);
  stage.user().freshness = 1;
  stage.run(0.05);
  EXPECT_TRUE(stage.user().grasp.active) << "the hand never opened and is still there";
}

TEST(Grasp, EndsWhenTheAgentIsSwitchedOff) {
  Stage stage = holding_part();
  stage.state->agent_enabled[0] = 0;
  stage.tick();
  EXPECT_FALSE(stage.user().grasp.active);
}

TEST(Grasp, TwoHandsHoldTwoBodies) {
  Stage stage = holding_part();
  stage.appear(1, HandKind::one_point);
  stage.touch(1, kCrank, 0, Vec3::UnitX());
  stage.tick();
  stage.user(1).sample.grasp_intent = 1;
  stage.run(0.05);
  EXPECT_EQ(stage.user(0).grasp.body, kPart);
  EXPECT_EQ(stage.user(1).grasp.body, kCrank);
  EXPECT_EQ(stage.value("GRASP.active"), 2);
}

RC_GTEST_PROP(Grasp, TwoHandsOnOneBodyLetGoEachOnItsOwn, ()) {
  Stage stage = holding_part();
  stage.appear(1, HandKind::one_point, Vec3(1, 0, -0.02));
  stage.touch(1, kPart, 0, -Vec3::UnitZ(), Vec3(1, 0, -0.01));
  stage.tick();
  stage.user(1).sample.grasp_intent = 1;
  stage.run(0.03);
  RC_ASSERT(stage.user(0).holds(kPart) && stage.user(1).holds(kPart));
  RC_ASSERT(stage.value("GRASP.active") == 2);
  const std::size_t first = *rc::gen::inRange<std::size_t>(0, 2);
  const bool takes_back = *rc::gen::arbitrary<bool>();
  const Vec3 p_BG = stage.user(1 - first).grasp.p_BG;
  stage.user(first).sample.grasp_intent = 0;
  stage.run(0.03);
  RC_ASSERT(!stage.user(first).grasp.active && stage.user(1 - first).holds(kPart));
  RC_ASSERT(stage.value("GRASP.active") == 1 && stage.value("GRASP.body") == 1);
  if (takes_back) stage.user(first).sample.grasp_intent = 1;
  stage.run(0.03);
  RC_ASSERT(stage.user(first).grasp.active == takes_back);
  RC_ASSERT(stage.user(1 - first).grasp.p_BG == p_BG);
  RC_ASSERT(stage.count(EventKind::released) == 1);
}

TEST(Grasp, RefusesWhenNothingCanBeGrasped) {
  state::WorldDescription world = with_grasp();
  world.agents[0].parameters["bodies"] = text({"FRAME"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("bodies"), {"simulation.grasp GRASP"}));
  world.agents[0].parameters["bodies"] = text({"HANDLE"});
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::unknown_name, line_of("bodies"), {"'HANDLE'", "FRAME, PART, CRANK"}));
}

}  // namespace
}  // namespace mechane::agents::test
