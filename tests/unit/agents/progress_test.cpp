// Activities, steps, triggers, commands, quantities and touches.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/support/allocation_guard.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::CommandKind;
using state::Comparison;
using state::EventKind;
using ::testing::HasSubstr;

/// Two activities. "assemble": PART's height above 0.5 for 0.1 s, then its x below 0. "use": three turns; HINGE on.
state::WorldDescription two_activities() {
  state::WorldDescription world = stage_world();
  world.bodies[1].object = std::make_shared<const collision::Object>();
  world.agents = {{"HINGE", "geometry.hinge", {{"joint", text({"AXLE"})}}, 10},
                  {"GRASP", "simulation.grasp", {}, 11},
                  {"SNAP", "geometry.snap", {{"object", text({"PART"})}, {"tolerance", number({0.01, 0.01})}}, 12}};
  world.quantities = {{"height", "PART.position.y", "m"}, {"x", "PART.position.x", "m"},  {"turns", "AXLE.turns", ""},
                      {"rate", "HINGE.rate", "rpm"},      {"angle", "AXLE.angle", "deg"}, {"held", "GRASP.active", ""},
                      {"falls", "PART.speed", "m/s"}};
  world.activities = {{"assemble", StepId(0), {}}, {"use", StepId(2), {}}};
  world.steps.resize(3);
  world.steps[0] = {
      "lift", ActivityId(0), {}, {}, {}, {{QuantityId(0), Comparison::greater, 0.5, 1e-6, 0.1, StepId(1)}}, {}, 0.05};
  world.steps[1] = {"aside",
                    ActivityId(0),
                    {AgentId(2)},
                    {},
                    {{BodyId(1), {}, false, false, {}}},
                    {{QuantityId(1), Comparison::less, 0, 1e-6, 0, StepId::none()}},
                    {},
                    20};
  world.steps[2] = {"turn",
                    ActivityId(1),
                    {AgentId(0)},
                    {AgentId(1)},
                    {{BodyId(1), false, {}, {}, Pose{Vec3(0, 0.3, 0), Quat::Identity()}}},
                    {{QuantityId(2), Comparison::equal, 3, 0.01, 0, StepId::none()}},
                    {},
                    20};
  return world;
}

state::Command command(std::uint64_t id, CommandKind kind, std::uint32_t argument = 0) {
  return {id, kind, argument};
}

TEST(Progress, StartsInTheFirstStepWithTheSwitchesOfTheSteps) {
  const Stage stage(two_activities());
  EXPECT_EQ(stage.state->progress.activity, ActivityId(0));
  EXPECT_EQ(stage.state->progress.step, StepId(0));
  EXPECT_EQ(stage.state->agent_enabled[0], 0) << "a step enables the hinge, so it is off until then";
  EXPECT_EQ(stage.state->agent_enabled[1], 1) << "no step enables the grasp: it is on";
  EXPECT_EQ(stage.count(EventKind::activity_started), 1);
  EXPECT_EQ(stage.count(EventKind::step_started), 1);
}

TEST(Progress, ATriggerMustHoldForItsTimeWithoutABreak) {
  Stage stage(two_activities());
  state::BodyState& part = stage.state->bodies[1];
  part.X_WB.p.y() = 0.6;
  stage.run(0.09);
  part.X_WB.p.y() = 0.4;
  stage.tick();
  part.X_WB.p.y() = 0.6;
  stage.run(0.099);
  EXPECT_EQ(stage.state->progress.step, StepId(0));
  stage.tick();
  EXPECT_EQ(stage.state->progress.step, StepId(1));
  EXPECT_EQ(stage.state->progress.steps_done, 1u);
  EXPECT_EQ(stage.state->agent_enabled[2], 1);
  EXPECT_FALSE(part.visible);
  EXPECT_FALSE(part.graspable);
}

/// The step "lift" waits for the height, and for x above 2.
state::WorldDescription two_rules(bool any) {
  state::WorldDescription world = two_activities();
  world.steps[0].triggers[0].more = {{QuantityId(1), Comparison::greater, 2, 1e-6}};
  world.steps[0].triggers[0].any = any;
  return world;
}

RC_GTEST_PROP(Progress, RulesTogetherHoldAsAllOrAny, ()) {
  const bool any = *rc::gen::arbitrary<bool>();
  const bool high = *rc::gen::arbitrary<bool>();
  const bool aside = *rc::gen::arbitrary<bool>();
  Stage stage(two_rules(any));
  stage.state->bodies[1].X_WB.p = Vec3(aside ? 3 : 1, high ? 0.6 : 0.4, 0);
  stage.run(0.2);
  RC_ASSERT((stage.state->progress.step == StepId(1)) == (any ? high || aside : high && aside));
}

TEST(Progress, AllRulesMustHoldAtOnceForTheHoldTime) {
  Stage stage(two_rules(false));
  for (int n = 0; n < 6; ++n) {
    stage.state->bodies[1].X_WB.p = n % 2 == 0 ? Vec3(3, 0.4, 0) : Vec3(1, 0.6, 0);
    stage.run(0.15);
  }
  EXPECT_EQ(stage.state->progress.step, StepId(0)) << "each held, but never both";
  stage.state->bodies[1].X_WB.p = Vec3(3, 0.6, 0);
  stage.run(0.11);
  EXPECT_EQ(stage.state->progress.step, StepId(1));
}

TEST(Progress, AStepIsLeftWhenItsTimeIsOut) {
  state::WorldDescription world = two_activities();
  world.steps[0].timeout_s = 0.5;
  world.steps[0].timeout_next = StepId(1);
  world.steps[1].timeout_s = 0.2;
  Stage stage(world);
  stage.run(0.498);
  EXPECT_EQ(stage.state->progress.step, StepId(0));
  stage.run(0.003);
  EXPECT_EQ(stage.state->progress.step, StepId(1));
  EXPECT_FALSE(stage.state->progress.done);
  stage.run(0.198);
  EXPECT_FALSE(stage.state->progress.done) << "the next step has its own time";
  stage.run(0.003);
  EXPECT_TRUE(stage.state->progress.done) << "a time-out without a next step ends the activity";
}

TEST(Progress, TheLastTriggerEndsTheActivityAndSaysHowLongItTook) {
  Stage stage(two_activities());
  stage.state->bodies[1].X_WB.p = Vec3(-1, 1, 0);
  stage.run(0.2);
  EXPECT_TRUE(stage.state->progress.done);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::activity_done, &event), 1);
  EXPECT_EQ(event.subject, 0u);
  EXPECT_NEAR(event.value, 0.101, 1e-9);
  EXPECT_EQ(stage.state->progress.steps_done, 2u);
  stage.run(0.2);
  EXPECT_EQ(stage.count(EventKind::activity_done), 1);
}

TEST(Progress, AHintIsDueAfterItsTimeInTheStep) {
  Stage stage(two_activities());
  stage.run(0.049);
  EXPECT_FALSE(stage.state->progress.hint_shown);
  stage.run(0.002);
  EXPECT_TRUE(stage.state->progress.hint_shown);
}

TEST(Progress, StartingAnActivityPutsTheWorldBackAndRunsItsFirstStep) {
  Stage stage(two_activities());
  stage.state->bodies[2].X_WB.p = Vec3(5, 5, 5);
  stage.state->joints[0].position = 40;
  stage.state->memory[stage.layout.find("GRASP.user0.was_open")->index] = 0;
  stage.appear(0, hand::HandKind::one_point);
  stage.user().grasp.active = true;
  stage.user().grasp.body = BodyId(2);
  stage.tick({command(42, CommandKind::start_activity, 1)});
  EXPECT_EQ(stage.state->progress.activity, ActivityId(1));
  EXPECT_EQ(stage.state->progress.step, StepId(2));
  EXPECT_EQ(stage.state->bodies[2].X_WB.p, Vec3(0, 0, 0));
  EXPECT_EQ(stage.state->joints[0].position, 0);
  EXPECT_FALSE(stage.user().grasp.active);
  EXPECT_EQ(stage.count(EventKind::released), 1);
  EXPECT_EQ(stage.state->agent_enabled[0], 1);
  EXPECT_EQ(stage.state->agent_enabled[1], 0);
  EXPECT_TRUE(stage.state->joints[0].enabled) << "the hinge agent runs in the same tick";
  EXPECT_EQ(stage.state->bodies[1].X_WB.p, Vec3(0, 0.3, 0)) << "the step puts it there";
  EXPECT_FALSE(stage.state->bodies[1].movable);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::command_done, &event), 1);
  EXPECT_EQ(event.value, 42);
  // And what triggers an `equal` is within its tolerance.
  stage.state->joints[0].position = 2 * kPi * 3.005;
  stage.tick();
  EXPECT_TRUE(stage.state->progress.done);
}

TEST(Progress, CommandsThatCannotBeAreRefused) {
  Stage stage(two_activities());
  stage.tick({command(1, CommandKind::start_activity, 2), command(2, CommandKind::none)});
  EXPECT_EQ(stage.count(EventKind::command_refused), 2);
  stage.tick({command(3, CommandKind::next_step)});
  EXPECT_EQ(stage.state->progress.step, StepId(1));
  stage.tick({command(4, CommandKind::next_step)});
  EXPECT_TRUE(stage.state->progress.done);
  stage.tick({command(5, CommandKind::next_step)});
  EXPECT_EQ(stage.count(EventKind::command_refused), 3);
  stage.tick({command(6, CommandKind::restart_activity)});
  EXPECT_EQ(stage.count(EventKind::command_done), 3);
  EXPECT_EQ(stage.state->progress.step, StepId(0));
  EXPECT_FALSE(stage.state->progress.done);
}

TEST(Progress, AWorldWithoutActivitiesRunsItsAgentsAndRefusesCommands) {
  state::WorldDescription world = two_activities();
  world.activities.clear();
  world.steps.clear();
  Stage stage(world);
  stage.tick({command(9, CommandKind::restart_activity)});
  EXPECT_EQ(stage.count(EventKind::command_refused), 1);
  EXPECT_TRUE(stage.state->joints[0].enabled);
}

RC_GTEST_PROP(Progress, RestartingAtAnyTimeGivesTheSameWorldAsAtFirst, ()) {
  Stage stage(two_activities());
  stage.tick();
  const std::vector<double> memory = stage.state->memory;
  const std::vector<double> quantities = stage.state->quantities;
  const int ticks = *rc::gen::inRange(1, 300);
  for (int n = 0; n < ticks; ++n) {
    stage.state->bodies[1].X_WB.p = Vec3(1 - 0.01 * n, 0.02 * n, 0);
    stage.tick();
  }
  stage.tick({command(1, CommandKind::start_activity, 0)});
  RC_ASSERT(stage.state->memory == memory);
  RC_ASSERT(stage.state->quantities == quantities);
  RC_ASSERT(stage.state->progress.step == StepId(0));
}

TEST(Quantities, ReadMemoryJointsAndBodiesInTheirUnits) {
  Stage stage(two_activities());
  stage.state->bodies[1].X_WB.p = Vec3(0.25, 0.5, 0);
  stage.state->bodies[1].V_WB.v = Vec3(0, -4, 3);
  stage.state->joints[0].position = 3 * kPi;
  stage.state->joints[0].velocity = kPi;
  stage.tick();
  EXPECT_EQ(stage.state->quantities[0], 0.5);
  EXPECT_EQ(stage.state->quantities[1], 0.25);
  EXPECT_DOUBLE_EQ(stage.state->quantities[2], 1.5);
  EXPECT_DOUBLE_EQ(stage.state->quantities[3], 30) << "rad/s shown as turns a minute";
  EXPECT_DOUBLE_EQ(stage.state->quantities[4], 540) << "rad shown as degrees";
  EXPECT_DOUBLE_EQ(stage.state->quantities[6], 5);
}

TEST(Quantities, AnUnknownSourceIsAnErrorThatListsWhatExists) {
  state::WorldDescription world = two_activities();
  world.quantities[2].source = "AXLE.speed";
  const Error error = error_of(world);
  EXPECT_THAT(error, is_error(ErrorCode::unknown_name, 0,
                              {"quantity turns", "'AXLE.speed'", "use one of: HINGE.angle", "PART.position.x|y|z"}));
  EXPECT_THAT(error.remedy, ::testing::Not(HasSubstr("user0"))) << "what agents keep to themselves is not offered";
}

TEST(Touches, SayWhenAHandComesToABodyAndNotWhileItTrembles) {
  Stage stage(two_activities());
  stage.appear(0, hand::HandKind::one_point);
  for (int n = 0; n < 200; ++n) {
    stage.lift_off();
    if (n % 20 < 10) stage.touch(0, BodyId(1), 0, Vec3::UnitX());
    stage.tick();
  }
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::touched, &event), 1);
  EXPECT_EQ(event.object, 1u);
  stage.lift_off();
  stage.run(0.3);
  stage.touch(0, BodyId(1), 0, Vec3::UnitX());
  stage.tick();
  EXPECT_EQ(stage.count(EventKind::touched), 2);
}

TEST(AgentSet, RefusesStepsThatPointNowhere) {
  state::WorldDescription world = two_activities();
  world.steps[0].triggers[0].next = StepId(9);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"step lift", "trigger", "name a step"}));
  world = two_activities();
  world.steps[0].triggers[0].quantity = QuantityId::none();
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"step lift", "name a quantity"}));
  world = two_rules(true);
  world.steps[0].triggers[0].more[0].quantity = QuantityId(77);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"step lift", "name a quantity"}));
  world = two_activities();
  world.steps[0].timeout_next = StepId(9);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"step lift", "time-out", "name a step"}));
  world = two_activities();
  world.steps[1].enable = {AgentId(77)};
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"name an agent"}));
  world = two_activities();
  world.steps[1].bodies[0].body = BodyId(77);
  EXPECT_THAT(error_of(world), is_error(ErrorCode::unknown_name, 0, {"name a body"}));
  world = two_activities();
  world.activities[1].first = StepId::none();
  EXPECT_THAT(error_of(world), is_error(ErrorCode::missing, 0, {"activity use"}));
  world = two_activities();
  world.agents[0].type = "geometry.string";
  EXPECT_THAT(error_of(world),
              is_error(ErrorCode::unknown_name, 10,
                       {"line 10, geometry.string HINGE", "'geometry.string'", "use one of: geometry.hinge"}));
}

TEST(AgentSet, ATickAllocatesNothing) {
  MECHANE_NOT_SANITIZED("a sanitizer's malloc cannot be counted");
  Stage stage(two_activities());
  stage.appear(0, hand::HandKind::glove);
  stage.touch(0, BodyId(1), 2, Vec3::UnitX());
  stage.touch(0, BodyId(1), 5, -Vec3::UnitX());
  const std::array<state::Command, 2> commands{command(1, CommandKind::restart_activity),
                                               command(2, CommandKind::next_step)};
  const mechane::test::AllocationGuard guard;
  for (int n = 0; n < 3000; ++n) {
    ++stage.state->tick;
    stage.state->event_count = 0;
    const bool with_commands = n % 500 == 499;
    stage.agents->run(*stage.state,
                      with_commands ? std::span<const state::Command>(commands) : std::span<const state::Command>(),
                      kStep);
  }
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
}

}  // namespace
}  // namespace mechane::agents::test
