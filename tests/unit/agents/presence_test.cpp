// simulation.lit, dwell, point, idle.
#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using hand::HandKind;
using state::EventKind;

state::WorldDescription with_agents(std::vector<state::ComponentDescription> agents) {
  state::WorldDescription world = stage_world();
  world.agents = std::move(agents);
  return world;
}

/// PART is a torch that CRANK, a hearth, is lit by; the torch itself is lit at FRAME.
state::WorldDescription with_fire() {
  return with_agents(
      {{"TORCH",
        "simulation.lit",
        {{"body", text({"PART"})}, {"flame", text({"FRAME"})}, {"time", number({0.2})}, {"burnTime", number({3})}},
        1},
       {"HEARTH",
        "simulation.lit",
        {{"body", text({"CRANK"})},
         {"flame", text({"PART"})},
         {"flamePoint", number({0, 0.5, 0})},
         {"at", number({0, 0, 1})},
         {"distance", number({0.05})},
         {"needs", text({"TORCH"})}},
        2}});
}

TEST(Lit, NeedsABurningFlameNearForItsTime) {
  Stage stage(with_fire());
  const auto bring_torch = [&](const Vec3& p) { stage.state->bodies[1].X_WB.p = p; };
  bring_torch(Vec3(0, -0.5, 1.04));
  stage.run(1);
  EXPECT_EQ(stage.value("HEARTH.lit"), 0) << "the torch does not burn";
  EXPECT_NEAR(stage.value("HEARTH.distance"), 0.04, 1e-9);
  bring_torch(Vec3(0.05, 0, 0));
  stage.run(0.19);
  EXPECT_EQ(stage.value("TORCH.lit"), 0);
  stage.run(0.02);
  EXPECT_EQ(stage.value("TORCH.lit"), 1);
  bring_torch(Vec3(0, -0.5, 1.04));
  stage.run(0.6);
  EXPECT_EQ(stage.value("HEARTH.lit"), 1);
  bring_torch(Vec3(9, 9, 9));
  stage.run(3);
  EXPECT_EQ(stage.value("TORCH.lit"), 0) << "burnt down";
  EXPECT_EQ(stage.value("HEARTH.lit"), 1);
  EXPECT_EQ(stage.count(EventKind::lit), 2);
}

/// HEARTH as above, lit by PART at once, behind a door on the stage's joint; its flames are FRAME.
state::WorldDescription with_door() {
  return with_agents({{"HEARTH",
                       "simulation.lit",
                       {{"body", text({"CRANK"})},
                        {"flame", text({"PART"})},
                        {"distance", number({10})},
                        {"time", number({0})},
                        {"shows", text({"FRAME"})},
                        {"door", text({"AXLE"})},
                        {"shutAt", number({0.4})},
                        {"smotherTime", number({0.5})}},
                       2}});
}

TEST(Lit, AFireBehindAShutDoorGoesOutAndIsNotLitAgain) {
  Stage stage(with_door());
  double& door = stage.state->joints[0].position;
  const std::size_t flames = stage.world.find_body("FRAME").index();
  stage.run(0.01);
  EXPECT_EQ(stage.value("HEARTH.lit"), 1);
  EXPECT_TRUE(stage.state->bodies[flames].visible);
  door = 0.39;
  stage.run(2);
  EXPECT_EQ(stage.value("HEARTH.lit"), 1) << "a gap is air enough";
  door = 0.41;
  stage.run(0.3);
  door = 0.2;
  stage.run(0.3);
  door = 0.41;
  stage.run(0.4);
  EXPECT_EQ(stage.value("HEARTH.lit"), 1) << "it had air in between";
  stage.run(0.2);
  EXPECT_EQ(stage.value("HEARTH.lit"), 0);
  EXPECT_FALSE(stage.state->bodies[flames].visible);
  stage.run(1);
  EXPECT_EQ(stage.count(EventKind::lit), 1) << "no flame is lit without air";
  door = 0;
  stage.run(0.01);
  EXPECT_EQ(stage.value("HEARTH.lit"), 1);
}

TEST(Lit, ADoorSaysWhenItIsShut) {
  state::WorldDescription world = with_door();
  world.agents[0].parameters.erase("shutAt");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, line_of("door"), {"'shutAt'"}));
  world = with_door();
  world.agents[0].parameters.erase("door");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, line_of("shutAt"), {"'door'"}));
}

TEST(Lit, RefusesWhatCannotBe) {
  state::WorldDescription world = with_fire();
  world.agents[0].parameters["flame"] = text({"PART"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("flame")));
  world = with_fire();
  world.agents[1].parameters["needs"] = text({"HEARTH"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("needs"), {"'HEARTH'", "simulation.lit"}));
}

TEST(Dwell, CountsWhileAHandOrABodyStays) {
  Stage stage(with_agents(
      {{"HAND",
        "simulation.dwell",
        {{"position", number({0, 1, 0})}, {"radius", number({0.2})}, {"time", number({0.5})}},
        1},
       {"BODY",
        "simulation.dwell",
        {{"at", text({"CRANK"})}, {"body", text({"PART"})}, {"radius", number({0.1})}, {"time", number({0.1})}},
        2}}));
  stage.appear(0, HandKind::glove, Vec3(0, 1.1, 0));
  stage.run(0.4);
  stage.user().X_WH.p = Vec3(0, 1.3, 0);
  stage.tick();
  EXPECT_EQ(stage.value("HAND.time"), 0) << "it went";
  stage.user().X_WH.p = Vec3(0, 1.1, 0);
  stage.run(0.499);
  EXPECT_EQ(stage.value("HAND.dwelt"), 0);
  stage.run(0.002);
  EXPECT_EQ(stage.value("HAND.dwelt"), 1);
  EXPECT_EQ(stage.value("BODY.inside"), 0);
  stage.state->bodies[1].X_WB.p = stage.state->bodies[2].X_WB.p;
  stage.run(0.2);
  EXPECT_EQ(stage.value("BODY.dwelt"), 1);
  EXPECT_EQ(stage.count(EventKind::dwelt), 2);
}

TEST(Point, TakesAFingertipAtTheSignOrAFingerThatPointsAtIt) {
  Stage stage(
      with_agents({{"NEAR",
                    "simulation.point",
                    {{"body", text({"PART"})}, {"distance", number({0.02})}, {"time", number({0.1})}},
                    1},
                   {"AIM",
                    "simulation.point",
                    {{"body", text({"PART"})}, {"cone", number({0.1})}, {"reach", number({2})}, {"time", number({0})}},
                    2}}));
  // PART is at (1, 0, 0). The finger points along its segment's x.
  stage.appear(0, HandKind::glove);
  auto& finger = stage.user().X_WS[6];
  finger.p = Vec3(1 - 0.0175 - 0.03, 0, 0);
  finger.R = Quat(Eigen::AngleAxisd(kPi / 2, Vec3::UnitZ()));
  stage.run(0.2);
  EXPECT_EQ(stage.value("NEAR.pointed"), 0);
  EXPECT_EQ(stage.value("AIM.pointed"), 0) << "it points up";
  finger.R = Quat::Identity();
  stage.run(0.2);
  EXPECT_NEAR(stage.value("NEAR.distance"), 0.03, 1e-9);
  EXPECT_EQ(stage.value("NEAR.pointed"), 0);
  EXPECT_EQ(stage.value("AIM.pointed"), 1);
  finger.p.x() += 0.015;
  stage.run(0.05);
  EXPECT_EQ(stage.value("NEAR.pointed"), 0) << "not for long enough";
  stage.run(0.1);
  EXPECT_EQ(stage.value("NEAR.pointed"), 1);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::pointed, &event), 2);
  EXPECT_EQ(event.object, 1u);
  stage.state->bodies[1].visible = false;
  stage.tick();
  EXPECT_EQ(stage.value("NEAR.pointed"), 0) << "a sign that is not there";
}

TEST(Point, TakesAClickForAFingerThatStaysForASecond) {
  const state::WorldDescription world =
      with_agents({{"SIGN", "simulation.point", {{"body", text({"PART"})}, {"time", number({0.3})}}, 1}});
  const state::Command on_part{7, state::CommandKind::click, 1};
  Stage stage(world);
  stage.tick({on_part});
  EXPECT_EQ(stage.value("SIGN.pointed"), 1);
  state::Event event;
  ASSERT_EQ(stage.count(EventKind::pointed, &event), 1);
  EXPECT_EQ(event.value, -1) << "nobody's hand";
  ASSERT_EQ(stage.count(EventKind::command_done, &event), 1);
  EXPECT_EQ(event.value, 7);
  stage.run(0.9);
  EXPECT_EQ(stage.value("SIGN.pointed"), 1);
  stage.run(0.2);
  EXPECT_EQ(stage.value("SIGN.pointed"), 0);
}

TEST(Point, AClickBesideASignIsRefused) {
  Stage stage(with_agents({{"SIGN", "simulation.point", {{"body", text({"PART"})}}, 1}}));
  const auto refused = [&](std::uint32_t body) {
    const int before = stage.count(EventKind::command_refused);
    stage.tick({{1, state::CommandKind::click, body}});
    return stage.value("SIGN.pointed") == 0 && stage.count(EventKind::command_refused) == before + 1;
  };
  EXPECT_TRUE(refused(0)) << "another body";
  EXPECT_TRUE(refused(1'000'000)) << "no body";
  stage.state->bodies[1].visible = false;
  EXPECT_TRUE(refused(1)) << "a sign that is not there";
  stage.state->bodies[1].visible = true;
  stage.state->agent_enabled[0] = 0;
  EXPECT_TRUE(refused(1)) << "a sign that is off";
}

TEST(Point, TakesAOnePointDeviceToo) {
  Stage stage(with_agents(
      {{"AIM", "simulation.point", {{"body", text({"PART"})}, {"cone", number({0.1})}, {"time", number({0})}}, 2}}));
  stage.appear(0, HandKind::one_point, Vec3(1, 0, 1));
  stage.tick();
  EXPECT_EQ(stage.value("AIM.pointed"), 1) << "it looks along -z";
  stage.user().X_WH.R = Quat(Eigen::AngleAxisd(0.2, Vec3::UnitY()));
  stage.tick();
  EXPECT_EQ(stage.value("AIM.pointed"), 0);
}

TEST(Idle, IsAHandThatRestsOrNone) {
  Stage stage(with_agents({{"QUIET", "simulation.idle", {{"time", number({2})}}, 1}}));
  stage.run(1.9);
  EXPECT_EQ(stage.value("QUIET.idle"), 0);
  stage.run(0.2);
  EXPECT_EQ(stage.value("QUIET.idle"), 1) << "nobody is there";
  stage.appear(0, HandKind::glove);
  stage.user().V_WH.v = Vec3(0.1, 0, 0);
  stage.tick();
  EXPECT_EQ(stage.value("QUIET.idle"), 0);
  stage.user().V_WH.v = Vec3(0.01, 0, 0);
  stage.run(1.5);
  EXPECT_NEAR(stage.value("QUIET.time"), 1.5, 1e-6) << "a tremble is not a motion";
  stage.touch(0, BodyId(1), 0, Vec3::UnitX());
  stage.tick();
  EXPECT_EQ(stage.value("QUIET.time"), 0);
  stage.lift_off();
  stage.run(2.1);
  EXPECT_EQ(stage.count(EventKind::idled), 2);
}

}  // namespace
}  // namespace mechane::agents::test
