#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

constexpr double kOwn_n_per_m = 300, kBaked_n_per_m = 2000, kWet_n_per_m = 100;
const BodyId kTouched(1);

/// PART, which is harder while BAKED is on, and soft and syrupy while WET is.
state::WorldDescription with_surfaces() {
  state::WorldDescription world = stage_world();
  world.bodies[1].haptic.stiffness_n_per_m = kOwn_n_per_m;
  world.bodies[1].haptic.static_friction = 0.7;
  world.agents = {{"BAKED", "touch.surface", {{"object", text({"PART"})}, {"stiffness", number({kBaked_n_per_m})}}, 3},
                  {"WET",
                   "touch.surface",
                   {{"object", text({"PART"})}, {"stiffness", number({kWet_n_per_m})}, {"viscosity", number({1})}},
                   4}};
  return world;
}

double felt_n_per_m(const Stage& stage) {
  return (*stage.state)[kTouched].haptic.stiffness_n_per_m;
}

/// Of what is on, the last counts.
double wanted_n_per_m(const Stage& stage) {
  if (stage.state->agent_enabled[1] != 0) return kWet_n_per_m;
  return stage.state->agent_enabled[0] != 0 ? kBaked_n_per_m : kOwn_n_per_m;
}

RC_GTEST_PROP(Surface, ChangesWithTheStepButNeverUnderAHand, ()) {
  Stage stage(with_surfaces());
  stage.appear(0, hand::HandKind::glove);
  stage.appear(1, hand::HandKind::one_point);
  stage.tick();
  const int ticks = *rc::gen::inRange(1, 40);
  for (int i = 0; i < ticks; ++i) {
    for (auto& enabled : stage.state->agent_enabled)
      enabled = *rc::gen::element<std::uint8_t>(0, 1);
    bool touched = false;
    for (const std::size_t user : {0u, 1u}) {
      stage.lift_off(user);
      const BodyId body(*rc::gen::inRange<std::size_t>(0, 3));
      stage.touch(user, body, 0, Vec3::UnitY());
      touched = touched || body == kTouched;
    }
    const double before = felt_n_per_m(stage);
    stage.tick();
    RC_ASSERT(felt_n_per_m(stage) == (touched ? before : wanted_n_per_m(stage)));
    RC_ASSERT((*stage.state)[BodyId(2)].haptic.stiffness_n_per_m == state::HapticMaterial{}.stiffness_n_per_m);
  }
}

TEST(Surface, IsTheBodysOwnWhereNothingElseIsWritten) {
  Stage stage(with_surfaces());
  stage.tick();
  const state::HapticMaterial& wet = (*stage.state)[kTouched].haptic;
  EXPECT_EQ(wet.stiffness_n_per_m, kWet_n_per_m);
  EXPECT_EQ(wet.viscosity_ns_per_m, 1);
  EXPECT_EQ(wet.static_friction, 0.7);
  EXPECT_EQ(stage.value("WET.felt"), 1);
}

TEST(Surface, RefusesWhatABodyMayNotHaveEither) {
  state::WorldDescription world = with_surfaces();
  world.agents[0].parameters["dynamicFriction"] = number({0.8});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("dynamicFriction"), {"staticFriction"}));
  world = with_surfaces();
  world.agents[0].parameters["staticFriction"] = number({0.1});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, world.agents[0].line, {"dynamicFriction"}));
  world = with_surfaces();
  world.agents[0].parameters["grooveDepth"] = number({0.001});
  world.agents[0].parameters["grooveDirection"] = number({0, 0, 1});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::conflict, line_of("grooveDepth"), {"too steep"}));
  world = with_surfaces();
  world.agents[0].parameters["stiffness"] = number({30000});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("stiffness"), {"20000"}));
}

}  // namespace
}  // namespace mechane::agents::test
