// simulation.pulled, pushed, fired.
#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::EventKind;

state::WorldDescription with_effort(const std::string& type, std::map<std::string, state::Parameter> parameters) {
  state::WorldDescription world = stage_world();
  parameters["body"] = text({"PART"});
  world.agents = {{"EFFORT", type, std::move(parameters), 3},
                  {"HINGE", "geometry.hinge", {{"joint", text({"AXLE"})}}, 4}};
  return world;
}

/// User 0 holds PART and pulls it with f_B_W.
void pull(Stage& stage, const Vec3& f_B_W) {
  stage.user().grasp.active = true;
  stage.user().grasp.body = BodyId(1);
  stage.user().grasp.reaction_W.f = -f_B_W;
}

TEST(Pulled, NeedsTheForceAlongItsAxisForItsTime) {
  Stage stage(
      with_effort("simulation.pulled", {{"force", number({4})}, {"axis", number({0, 0, 2})}, {"time", number({0.1})}}));
  stage.state->bodies[1].X_WB.R = Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitY()));  // its z is the world's x
  stage.appear(0, hand::HandKind::one_point);
  pull(stage, Vec3(3.9, 8, 8));
  stage.run(0.3);
  EXPECT_EQ(stage.value("EFFORT.pulled"), 0) << "across the axis counts nothing";
  EXPECT_NEAR(stage.value("EFFORT.force"), 3.9, 1e-9);
  pull(stage, Vec3(4.1, 0, 0));
  stage.run(0.09);
  EXPECT_EQ(stage.value("EFFORT.pulled"), 0) << "not for long enough";
  stage.run(0.02);
  EXPECT_EQ(stage.value("EFFORT.pulled"), 1);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::pulled, &event), 1);
  EXPECT_EQ(event.object, 1u);
  stage.user().grasp = {};
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pulled"), 0);
}

TEST(Pulled, CountsTheWayFromWhereTheHandCame) {
  Stage stage(with_effort("simulation.pulled", {{"travel", number({0.1})}}));
  stage.appear(0, hand::HandKind::one_point);
  stage.state->bodies[1].X_WB.p.x() += 5;
  stage.run(0.01);
  pull(stage, Vec3::Zero());
  stage.tick();
  stage.state->bodies[1].X_WB.p.y() += 0.09;
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pulled"), 0);
  stage.state->bodies[1].X_WB.p.y() += 0.02;
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pulled"), 1);
  EXPECT_NEAR(stage.value("EFFORT.travel"), 0.11, 1e-9);
}

TEST(Pulled, MayCountAJointsWay) {
  Stage stage(
      with_effort("simulation.pulled", {{"travel", number({0.5})}, {"joint", text({"AXLE"})}, {"reverse", true}}));
  stage.appear(0, hand::HandKind::one_point);
  stage.state->joints[0].position = 3;
  pull(stage, Vec3::Zero());
  stage.tick();
  stage.state->joints[0].position = 2.4;
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pulled"), 1);
}

TEST(Pushed, IsATouchThatPressesAndNotAHold) {
  Stage stage(with_effort("simulation.pushed", {{"force", number({2})}, {"axis", number({1, 0, 0})}}));
  stage.appear(0, hand::HandKind::one_point);
  stage.user().output.force_W.f = Vec3(-2.5, 0, 0);  // the body pushes back on the hand
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pushed"), 0) << "the hand touches nothing";
  stage.touch(0, BodyId(2), 0, Vec3(-1, 0, 0));
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pushed"), 0) << "another body";
  stage.touch(0, BodyId(1), 0, Vec3(-1, 0, 0));
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pushed"), 1);
  EXPECT_NEAR(stage.value("EFFORT.force"), 2.5, 1e-9);
  EXPECT_EQ(stage.count(EventKind::pushed), 1);
  pull(stage, Vec3(5, 0, 0));
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.pushed"), 0);
}

TEST(Fired, ReleasesOnceAndIsCockedAgainByItsSwitch) {
  Stage stage(with_effort("simulation.fired", {{"force", number({3})}, {"releases", text({"HINGE"})}}));
  stage.appear(0, hand::HandKind::one_point);
  stage.tick();
  EXPECT_TRUE(stage.state->joints[0].enabled);
  pull(stage, Vec3(0, 3.5, 0));
  stage.tick();
  EXPECT_EQ(stage.value("EFFORT.fired"), 1);
  EXPECT_FALSE(stage.state->joints[0].enabled) << "in the same tick";
  stage.state->agent_enabled[1] = 1;
  stage.run(0.05);
  EXPECT_TRUE(stage.state->joints[0].enabled) << "it released once";
  EXPECT_EQ(stage.count(EventKind::fired), 1);
  stage.state->agent_enabled[0] = 0;
  stage.tick();
  stage.state->agent_enabled[0] = 1;
  stage.tick();
  EXPECT_EQ(stage.count(EventKind::fired), 2);
}

TEST(Efforts, RefuseWhatCannotBe) {
  EXPECT_THAT(error_of(with_effort("simulation.pulled", {})), is_error(ErrorCode::missing, 3, {"force", "travel"}));
  EXPECT_THAT(error_of(with_effort("simulation.pushed", {{"force", number({1})}, {"axis", number({0, 0, 0})}})),
              is_error(ErrorCode::invalid_value, line_of("axis"), {"'axis'"}));
  EXPECT_THAT(error_of(with_effort("simulation.fired", {{"force", number({1})}, {"releases", text({"EFFORT"})}})),
              is_error(ErrorCode::conflict, line_of("releases"), {"'releases'"}));
  state::WorldDescription world = with_effort("simulation.pulled", {{"force", number({1})}, {"joint", text({"AXLE"})}});
  world.joints[0].kind = state::JointKind::ball;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("joint"), {"'AXLE'", "SliderJoint"}));
}

}  // namespace
}  // namespace mechane::agents::test
