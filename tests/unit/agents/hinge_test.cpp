#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

state::WorldDescription with_hinge(std::map<std::string, state::Parameter> parameters) {
  state::WorldDescription world = stage_world();
  parameters["joint"] = text({"AXLE"});
  world.agents = {{"HINGE", "geometry.hinge", std::move(parameters), 7}};
  return world;
}

TEST(Hinge, SwitchesItsJointAndSetsWhatItFeelsLike) {
  state::WorldDescription world = with_hinge({{"frictionTorque", number({4})},
                                              {"viscous", number({2})},
                                              {"minAngle", number({-1})},
                                              {"maxAngle", number({2})}});
  world.effort_scale = 0.05;
  Stage stage(world);
  stage.tick();
  const state::JointState& joint = stage.state->joints[0];
  EXPECT_TRUE(joint.enabled);
  EXPECT_DOUBLE_EQ(joint.friction, 0.2) << "felt by the effort scale";
  EXPECT_DOUBLE_EQ(joint.viscous, 0.1);
  EXPECT_EQ(joint.min_position, -1);
  EXPECT_EQ(joint.max_position, 2);
  stage.state->agent_enabled[0] = 0;
  stage.tick();
  EXPECT_FALSE(joint.enabled);
}

TEST(Hinge, WithoutLimitsLeavesTheJointsOwn) {
  state::WorldDescription world = with_hinge({});
  world.joints[0].min_position = -3;
  world.joints[0].max_position = 4;
  Stage stage(world);
  stage.tick();
  EXPECT_EQ(stage.state->joints[0].max_position, 4);
}

TEST(Hinge, OffersAngleRateAndTurns) {
  Stage stage(with_hinge({}));
  stage.state->joints[0].position = -5 * kPi;
  stage.state->joints[0].velocity = 1.5;
  stage.tick();
  EXPECT_EQ(stage.value("HINGE.angle"), -5 * kPi);
  EXPECT_EQ(stage.value("HINGE.rate"), 1.5);
  EXPECT_DOUBLE_EQ(stage.value("HINGE.turns"), -2.5);
}

TEST(Hinge, RefusesWhatCannotBe) {
  EXPECT_THAT(error_of(with_hinge({{"minAngle", number({1})}})),
              is_error(ErrorCode::missing, line_of("minAngle"), {"geometry.hinge HINGE", "maxAngle"}));
  EXPECT_THAT(error_of(with_hinge({{"minAngle", number({1})}, {"maxAngle", number({0})}})),
              is_error(ErrorCode::conflict, line_of("minAngle"), {"minAngle", "maxAngle"}));
  EXPECT_THAT(error_of(with_hinge({{"frictionTorque", number({-1})}})),
              is_error(ErrorCode::invalid_value, line_of("frictionTorque"), {"frictionTorque", "-1", "from 0"}));
  state::WorldDescription slider = with_hinge({});
  slider.joints[0].kind = state::JointKind::slider;
  EXPECT_THAT(error_of(slider),
              is_error(ErrorCode::invalid_value, line_of("joint"), {"'AXLE'", "SingleAxisHingeJoint"}));
  state::WorldDescription twice = with_hinge({});
  twice.agents.push_back(twice.agents[0]);
  twice.agents[1].name = "AGAIN";
  EXPECT_THAT(error_of(twice), is_error(ErrorCode::conflict, line_of("joint"), {"'AGAIN'"}));
}

}  // namespace
}  // namespace mechane::agents::test
