// geometry.gear, worm, intermittent_gear, ratchet.
#include "tests/unit/agents/machine_stage.hpp"

namespace mechane::agents::test {
namespace {

state::WorldDescription geared(const std::string& type, std::map<std::string, state::Parameter> parameters) {
  state::WorldDescription world = wheel_world({0.05, 0.02});
  parameters["joint1"] = text({"HINGE0"});
  parameters["joint2"] = text({"HINGE1"});
  world.agents = {agent("A", "geometry.hinge", {{"joint", text({"HINGE0"})}}),
                  agent("B", "geometry.hinge", {{"joint", text({"HINGE1"})}}), agent("GEAR", type, parameters)};
  return world;
}

TEST(GearAgent, WheelsOfTeethTurnAgainstEachOther) {
  MachineStage stage(geared("geometry.gear", {{"teeth", number({20, 50})}}));
  stage.run_loaded(1, 0, 0.2);
  EXPECT_GT(stage.value("A.turns"), 0.1);
  EXPECT_NEAR(stage.value("B.turns"), -0.4 * stage.value("A.turns"), 1e-9);
  EXPECT_EQ(stage.value("GEAR.engaged"), 1);
  EXPECT_NEAR(stage.value("GEAR.torque"), 0.02 * 0.4 * 0.2 / (0.05 + 0.16 * 0.02), 1e-6);
}

TEST(GearAgent, MeshesWhereTheWheelsStandWhenOneIsPutIn) {
  MachineStage stage(geared("geometry.gear", {{"ratio", number({3})}}));
  stage.state->agent_enabled[1] = 0;  // the second wheel is missing
  stage.run_loaded(0.5, 0, 0.2);
  EXPECT_EQ(stage.value("GEAR.engaged"), 0);
  EXPECT_EQ(stage.value("B.turns"), 0);
  const double from = stage.state->joints[0].position;
  ASSERT_GT(from, 0.4);
  stage.state->agent_enabled[1] = 1;
  stage.run_loaded(0.5, 0, 0.2);
  EXPECT_NEAR(stage.state->joints[1].position, 3 * (stage.state->joints[0].position - from), 5e-3)
      << "no jerk to make up for what it missed";
}

TEST(GearAgent, RefusesWhatCannotBe) {
  EXPECT_THAT(error_of(geared("geometry.gear", {})), is_error(ErrorCode::missing, 9, {"ratio", "teeth", "radius"}));
  EXPECT_THAT(error_of(geared("geometry.gear", {{"ratio", number({1})}, {"radius", number({1})}})),
              is_error(ErrorCode::conflict, line_of("radius"), {"more than one"}));
  EXPECT_THAT(error_of(geared("geometry.gear", {{"radius", number({1})}})),
              is_error(ErrorCode::conflict, line_of("radius"), {"joint2"}));
  EXPECT_THAT(error_of(geared("geometry.gear", {{"ratio", number({0})}})),
              is_error(ErrorCode::invalid_value, line_of("ratio")));
  state::WorldDescription world = geared("geometry.gear", {{"ratio", number({1})}});
  world.agents[2].parameters["joint2"] = text({"HINGE0"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("joint2")));
}

TEST(WormAgent, TurnsItsWheelAndIsNotTurnedByIt) {
  MachineStage stage(geared("geometry.worm", {{"teeth", number({8})}}));
  stage.run_loaded(1, 1, 5);
  EXPECT_LT(std::abs(stage.value("A.turns")), 1e-6);
  EXPECT_LT(std::abs(stage.value("B.turns")), 1e-6);
  stage.run_loaded(1, 0, 0.2);
  EXPECT_GT(stage.value("A.turns"), 0.1);
  EXPECT_NEAR(stage.value("B.turns"), stage.value("A.turns") / 8, 1e-6);
}

TEST(IntermittentGearAgent, DropsAStepATurnAsTheOdometerDoes) {
  MachineStage stage(geared("geometry.intermittent_gear", {{"teeth", number({40})}, {"window", number({0.4})}}));
  int ticks = 0;
  while (stage.value("A.turns") < 5.2) {
    stage.tick();
    stage.state->joints[0].load = 1.0 * (8 - stage.state->joints[0].velocity);
    stage.dynamics->step(*stage.state, kStep);
    ASSERT_LT(++ticks, 20000);
  }
  EXPECT_EQ(stage.value("GEAR.steps"), 5);
  EXPECT_NEAR(stage.value("B.turns"), -5.0 / 40, 1e-5);
}

state::WorldDescription ratcheted() {
  state::WorldDescription world = wheel_world({0.05, 0.01});
  world.agents = {agent("DRUM", "geometry.hinge", {{"joint", text({"HINGE0"})}}),
                  agent("PAWL", "geometry.ratchet",
                        {{"joint", text({"HINGE0"})}, {"teeth", number({12})}, {"pawl", text({"HINGE1"})}})};
  return world;
}

TEST(RatchetAgent, GoesOnAndIsHeldByTheLastToothAndFreedByItsPawl) {
  MachineStage stage(ratcheted());
  const double tooth = 2 * kPi / 12;
  stage.state->bodies[1].V_WB.w.z() = 2.5 * tooth / 0.5;
  stage.run_machine(0.5);
  EXPECT_EQ(stage.value("PAWL.tooth"), 2);
  stage.state->bodies[1].V_WB = {};
  stage.run_loaded(1, 0, -0.3);
  EXPECT_NEAR(stage.state->joints[0].position, 2 * tooth, 1e-4);
  EXPECT_EQ(stage.value("PAWL.holding"), 1);
  EXPECT_NEAR(stage.value("PAWL.torque"), 0.3, 1e-4);
  stage.state->bodies[2].V_WB.w.z() = 1;  // a hand lifts the pawl
  stage.run_loaded(0.6, 0, -0.3);
  EXPECT_EQ(stage.value("PAWL.engaged"), 0);
  EXPECT_LT(stage.state->joints[0].position, 1.5 * tooth);
}

TEST(RatchetAgent, SwitchedOffHoldsNothing) {
  MachineStage stage(ratcheted());
  stage.state->agent_enabled[1] = 0;
  stage.run_loaded(0.5, 0, -0.3);
  EXPECT_LT(stage.state->joints[0].position, -0.5);
}

TEST(RatchetAgent, RefusesWhatCannotBe) {
  state::WorldDescription world = ratcheted();
  world.agents[1].parameters.erase("teeth");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, 9, {"teeth", "pitch"}));
  world = ratcheted();
  world.agents[1].parameters["pawl"] = text({"HINGE0"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("pawl"), {"'pawl'"}));
  world = ratcheted();
  world.agents[1].parameters["pitch"] = number({0.1});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("pitch"), {"both"}));
  world = ratcheted();
  world.joints[0].kind = state::JointKind::slider;
  world.agents.erase(world.agents.begin());
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("teeth"), {"slider"}));
}

}  // namespace
}  // namespace mechane::agents::test
