#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::EventKind;

state::WorldDescription with_turned() {
  state::WorldDescription world = stage_world();
  world.agents = {{"COUNT", "simulation.turned", {{"joint", text({"AXLE"})}}, 4}};
  return world;
}

TEST(Turned, SaysEachWholeTurnOnceFromWhereItBegan) {
  Stage stage(with_turned());
  stage.state->agent_enabled[0] = 0;
  stage.state->joints[0].position = 100;
  stage.tick();
  stage.state->agent_enabled[0] = 1;
  stage.tick();
  EXPECT_EQ(stage.value("COUNT.turns"), 0);
  for (int n = 0; n <= 3600; ++n) {
    stage.state->joints[0].position = 100 + 2 * kPi * 3.6 * n / 3600.0;
    stage.tick();
  }
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::turned, &event), 3);
  EXPECT_EQ(event.value, 3);
  EXPECT_EQ(event.subject, 0u);
  EXPECT_NEAR(stage.value("COUNT.turns"), 3.6, 1e-9);
  stage.state->joints[0].position = 100;
  stage.tick();
  stage.state->joints[0].position = 100 + 2 * kPi * 3.2;
  stage.tick();
  EXPECT_EQ(stage.count(EventKind::turned), 3) << "going back and forth counts nothing twice";
}

TEST(Turned, CountsBackwardsToo) {
  Stage stage(with_turned());
  stage.tick();
  stage.state->joints[0].position = -2 * kPi * 1.01;
  stage.tick();
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::turned, &event), 1);
  EXPECT_EQ(event.value, -1);
}

TEST(Turned, NeedsAHinge) {
  state::WorldDescription world = with_turned();
  world.joints[0].kind = state::JointKind::ball;
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("joint"), {"SingleAxisHingeJoint"}));
}

}  // namespace
}  // namespace mechane::agents::test
