// geometry.rope and geometry.breakable.
#include "server/state/snapshot.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/unit/agents/machine_stage.hpp"

namespace mechane::agents::test {
namespace {

constexpr double kG = 9.81;

/// A winch whose rope goes over a beam's sheave to a stone of 20 kg; a ratchet holds it.
state::WorldDescription crane() {
  state::WorldDescription world = wheel_world({0.3});
  add_block(world, "STONE", 20, Vec3(0.6, 0, 0));
  world.agents = {agent("WINCH", "geometry.hinge", {{"joint", text({"HINGE0"})}}),
                  agent("PAWL", "geometry.ratchet", {{"joint", text({"HINGE0"})}, {"teeth", number({16})}}),
                  agent("ROPE", "geometry.rope",
                        {{"drum", text({"HINGE0"})},
                         {"drumRadius", number({0.1})},
                         {"bodies", text({"FRAME", "STONE"})},
                         {"points", number({0.5, 3, 0, 0, 0, 0})},
                         {"radii", number({0.1, 0})},
                         {"senses", number({-1, 1})},
                         {"efficiency", number({0.9})}})};
  return world;
}

TEST(RopeAgent, AWinchLiftsAStoneOnItAndARatchetHoldsIt) {
  MachineStage stage(crane());
  const double start = stage.value("ROPE.length_m");
  stage.run_machine(1);
  EXPECT_NEAR(stage.state->bodies[2].X_WB.p.y(), 0, 5e-3) << "the pawl holds the stone";
  EXPECT_NEAR(stage.value("ROPE.end_tension_n"), 20 * kG, 1);
  while (stage.value("WINCH.turns") < 2) {
    stage.tick();
    stage.state->joints[0].load = 25 + 10 * (3 - stage.state->joints[0].velocity);
    stage.dynamics->step(*stage.state, kStep);
    ASSERT_LT(stage.state->tick, 20000u);
  }
  const double wound = stage.value("WINCH.turns") * 2 * kPi * 0.1;
  EXPECT_NEAR(stage.state->bodies[2].X_WB.p.y(), wound, 0.03);
  EXPECT_NEAR(start - stage.value("ROPE.length_m"), wound, 0.03);
  EXPECT_NEAR(stage.value("ROPE.end_tension_n") / stage.value("ROPE.tension_n"), 0.9, 1e-3);
  const double high = stage.state->bodies[2].X_WB.p.y();
  stage.run_machine(2);
  EXPECT_GT(stage.state->bodies[2].X_WB.p.y(), high - 2 * kPi * 0.1 / 16 - 0.02) << "by one tooth at most";
  stage.state->agent_enabled[2] = 0;
  stage.run_machine(0.3);
  EXPECT_LT(stage.state->bodies[2].X_WB.p.y(), high - 0.3) << "cut, the stone falls";
  EXPECT_EQ(stage.value("ROPE.tension_n"), 0);
}

TEST(RopeAgent, ATensionIsTheRealOne) {
  state::WorldDescription world = crane();
  world.effort_scale = 0.02;
  world.bodies[2].effort_scale = 0.02;
  MachineStage stage(world);
  stage.run_machine(1);
  EXPECT_NEAR(stage.value("ROPE.end_tension_n"), 20 * kG, 1);
}

TEST(RopeAgent, RefusesWhatCannotBe) {
  state::WorldDescription world = crane();
  world.agents[2].parameters["points"] = number({1, 2, 3});
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::invalid_value, line_of("points"), {"points has 3 numbers for 2 bodies"}));
  world = crane();
  world.agents[2].parameters.erase("drumRadius");
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, line_of("drum"), {"drumRadius"}));
  world = crane();
  world.agents[2].parameters["radii"] = number({1});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("radii"), {"radii", "1", "2 bodies"}));
  world = crane();
  world.agents[2].parameters.erase("drum");
  world.agents[2].parameters["bodies"] = text({"STONE"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("bodies"), {"1", "name 2 to"}));
}

state::WorldDescription with_breakable(const std::string& target, std::map<std::string, state::Parameter> parameters) {
  state::WorldDescription world = crane();
  parameters["agent"] = text({target});
  world.agents.push_back(agent("WEAK", "geometry.breakable", std::move(parameters)));
  state::StepDescription step;
  step.name = "step";
  step.activity = ActivityId(0);
  world.steps = {step};
  world.activities = {{"use", StepId(0), {}}};
  return world;
}

TEST(BreakableAgent, ARopeTearsOverItsForceAndStaysTornUntilTheActivityBeginsAnew) {
  MachineStage stage(with_breakable("ROPE", {{"force", number({300})}}));
  stage.run_machine(1);
  EXPECT_EQ(stage.value("WEAK.broken"), 0) << "20 kg it bears";
  stage.state->bodies[2].V_WB.v.y() = -2;  // jerked
  stage.run_machine(0.5);
  EXPECT_EQ(stage.value("WEAK.broken"), 1);
  EXPECT_EQ(stage.count(state::EventKind::broke), 1);
  stage.state->agent_enabled[2] = 1;  // whatever a step says
  stage.run_machine(0.2);
  EXPECT_LT(stage.state->bodies[2].X_WB.p.y(), -1);
  stage.step({{1, state::CommandKind::restart_activity, 0}});
  stage.run_machine(0.5);
  EXPECT_EQ(stage.value("WEAK.broken"), 0);
  EXPECT_NEAR(stage.state->bodies[2].X_WB.p.y(), 0, 5e-3) << "mended, it holds";
}

TEST(BreakableAgent, AHingeBreaksByItsLoadAndNotByLess) {
  for (const double load : {380.0, 420.0}) {
    state::WorldDescription world = with_breakable("WINCH", {{"force", number({400})}});
    world.agents[0].parameters["frictionTorque"] = number({1000});
    world.agents.erase(world.agents.begin() + 1, world.agents.begin() + 3);
    MachineStage stage(world);
    for (int n = 0; n < 100; ++n) {
      stage.tick();
      stage.state->bodies[1].load_W.f = Vec3(0, -load, 0);
      stage.dynamics->step(*stage.state, kStep);
    }
    EXPECT_EQ(stage.value("WEAK.broken") == 1, load > 400);
    EXPECT_EQ(stage.state->bodies[1].X_WB.p.y() < -0.1, load > 400);
  }
}

TEST(BreakableAgent, ATiedSnapLetsGo) {
  state::WorldDescription world = with_breakable("SEAT", {{"force", number({250})}});
  world.agents[1] = agent("SEAT", "geometry.snap",
                          {{"object", text({"STONE"})},
                           {"position", number({0.6, 0, 0})},
                           {"tolerance", number({0.05, 0.2})},
                           {"tied", true}});
  world.agents.erase(world.agents.begin() + 2);
  MachineStage stage(world);
  stage.run_machine(1);
  EXPECT_EQ(stage.value("SEAT.placed"), 1);
  EXPECT_NEAR(stage.value("WEAK.force"), 20 * kG, 1) << "it bears the stone, which is free to be pulled";
  EXPECT_TRUE(stage.state->bodies[2].movable);
  for (int n = 0; n < 300; ++n) {
    stage.tick();
    stage.state->bodies[2].load_W.f = Vec3(0, -100, 0);
    stage.dynamics->step(*stage.state, kStep);
  }
  EXPECT_EQ(stage.value("SEAT.placed"), 0);
  EXPECT_LT(stage.state->bodies[2].X_WB.p.y(), -0.3);
}

TEST(BreakableAgent, RefusesWhatCannotBe) {
  EXPECT_THAT(error_of(with_breakable("ROPE", {})),
              is_error(ErrorCode::missing, 9, {"geometry.breakable WEAK", "'torque'"}));
  state::WorldDescription world = with_breakable("HOLD", {{"force", number({1})}});
  world.agents.push_back(agent("HOLD", "simulation.grasp", {}));
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("agent"), {"'HOLD'", "simulation.grasp"}));
}

TEST(GeometryAgents, AllocateNothingAndGoOnFromASnapshotWithTheSameBits) {
  MachineStage live(with_breakable("ROPE", {{"force", number({1000})}}));
  MachineStage resumed(with_breakable("ROPE", {{"force", number({1000})}}));
  std::vector<std::byte> bytes;
  live.events.reserve(1000);
  for (int n = 0; n < 3000; ++n) {
    if (n == 1000) {
      state::write_snapshot(*live.state, bytes);
      ASSERT_TRUE(state::read_snapshot(bytes, *resumed.state));
    }
    for (MachineStage* stage : {&live, &resumed}) {
      if (stage == &resumed && n < 1000) continue;
      ++stage->state->tick;
      stage->state->event_count = 0;
      const mechane::test::AllocationGuard guard;
      stage->agents->run(*stage->state, {}, kStep);
      stage->state->joints[0].load = 30 * std::sin(4e-3 * n);
      stage->dynamics->step(*stage->state, kStep);
      if (mechane::test::AllocationGuard::available()) {
        ASSERT_EQ(guard.allocations(), 0u);
      }
    }
  }
  EXPECT_EQ(state::state_hash(*live.state), state::state_hash(*resumed.state));
}

}  // namespace
}  // namespace mechane::agents::test
