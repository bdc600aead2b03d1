// geometry.slider, ball, screw, fixed.
#include "tests/unit/agents/machine_stage.hpp"

namespace mechane::agents::test {
namespace {

state::WorldDescription sled_world() {
  state::WorldDescription world = wheel_world({0.1});
  world.joints[0].kind = state::JointKind::slider;
  world.agents = {agent("GUIDE", "geometry.slider",
                        {{"joint", text({"HINGE0"})},
                         {"friction", number({2})},
                         {"minPosition", number({-0.1})},
                         {"maxPosition", number({0.4})}})};
  return world;
}

TEST(SliderAgent, SlidesWithItsFrictionToItsStop) {
  MachineStage stage(sled_world());
  stage.run_loaded(0.5, 0, 3);
  EXPECT_NEAR(stage.value("GUIDE.speed"), 0.5, 2e-3) << "3 N less 2 N on 1 kg";
  EXPECT_NEAR(stage.value("GUIDE.position"), 0.125, 2e-3);
  stage.run_loaded(2, 0, 3);
  EXPECT_NEAR(stage.value("GUIDE.position"), 0.4, 1e-3);
  stage.run_loaded(1, 0, -1.9);
  EXPECT_NEAR(stage.value("GUIDE.position"), 0.4, 1e-3) << "friction holds";
}

TEST(SliderAgent, RefusesWhatCannotBe) {
  state::WorldDescription world = sled_world();
  world.joints[0].kind = state::JointKind::hinge;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("joint"), {"'HINGE0'", "SliderJoint"}));
  world = sled_world();
  world.agents[0].parameters.erase("maxPosition");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, line_of("minPosition"), {"maxPosition"}));
  world = sled_world();
  world.agents.push_back(agent("AGAIN", "geometry.slider", {{"joint", text({"HINGE0"})}}));
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("joint"), {"'AGAIN'"}));
}

TEST(BallAgent, KeepsTheBodyInItsConeAndSaysItsTilt) {
  state::WorldDescription world = wheel_world({0.1});
  world.joints[0].kind = state::JointKind::ball;
  world.bodies[1].use_gravity = true;
  world.bodies[1].p_BCm = Vec3(0.05, 0.3, 0);
  world.agents = {agent("BALL", "geometry.ball", {{"joint", text({"HINGE0"})}, {"coneAngle", number({0.4})}})};
  MachineStage stage(world);
  stage.run_machine(3);
  EXPECT_NEAR(stage.value("BALL.tilt"), 0.4, 5e-3);
  stage.state->agent_enabled[0] = 0;
  stage.run_machine(0.5);
  EXPECT_LT(stage.state->bodies[1].X_WB.p.y(), -0.5) << "off, it lets the body fall";
}

TEST(ScrewAgent, GoesByItsPitch) {
  state::WorldDescription world = wheel_world({0.1});
  world.agents = {agent("SCREW", "geometry.screw",
                        {{"joint", text({"HINGE0"})},
                         {"pitch", number({-0.05})},
                         {"maxAngle", number({4 * kPi})},
                         {"minAngle", number({0})}})};
  MachineStage stage(world);
  stage.run_loaded(3, 0, 1);
  EXPECT_NEAR(stage.value("SCREW.turns"), 2, 1e-3);
  EXPECT_NEAR(stage.value("SCREW.travel"), -0.1, 1e-4);
  EXPECT_NEAR(stage.state->bodies[1].X_WB.p.z(), -0.1, 1e-4);
}

state::WorldDescription tied_world() {
  state::WorldDescription world = wheel_world({0.1});
  add_block(world, "BLOCK", 2, Vec3(0.5, 0, 0));
  world.agents = {agent("TIE", "geometry.fixed", {{"body", text({"BLOCK"})}, {"to", text({"WHEEL0"})}}),
                  agent("HINGE", "geometry.hinge", {{"joint", text({"HINGE0"})}})};
  return world;
}

TEST(FixedAgent, TiesBodiesAsTheyStandWhenItIsSwitchedOn) {
  state::WorldDescription world = tied_world();
  world.effort_scale = 0.5;
  MachineStage stage(world);
  stage.state->agent_enabled[0] = 0;
  stage.run_machine(0.1);
  const Pose X = stage.state->bodies[1].X_WB.inverse() * stage.state->bodies[2].X_WB;
  ASSERT_LT(X.p.y(), -0.04) << "free, the block falls";
  stage.state->agent_enabled[0] = 1;
  stage.run_machine(1);
  const Pose now = stage.state->bodies[1].X_WB.inverse() * stage.state->bodies[2].X_WB;
  EXPECT_LT((now.p - X.p).norm(), 3e-3);
  EXPECT_GT(std::abs(stage.state->joints[0].position), 0.3) << "together they swing";
  const double felt_n = stage.state->couplings[0].force_n;
  stage.tick();
  EXPECT_DOUBLE_EQ(stage.value("TIE.force"), 2 * felt_n) << "said as the real force";
}

TEST(FixedAgent, RefusesWhatCannotBe) {
  state::WorldDescription world = tied_world();
  world.agents[0].parameters["to"] = text({"BLOCK"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("to")));
  world = tied_world();
  world.agents[0].parameters["body"] = text({"FRAME"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("body"), {"'FRAME'"}));
}

}  // namespace
}  // namespace mechane::agents::test
