#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::EventKind;

/// `placed` is written before its snap: the order of the description does not matter.
state::WorldDescription with_placed() {
  state::WorldDescription world = stage_world();
  world.agents = {{"DONE", "simulation.placed", {{"snap", text({"SNAP"})}}, 4},
                  {"SNAP", "geometry.snap", {{"object", text({"PART"})}, {"tolerance", number({0.1, 0.1})}}, 5},
                  {"HINGE", "geometry.hinge", {{"joint", text({"AXLE"})}}, 6}};
  return world;
}

TEST(Placed, SaysOnceThatTheBodyIsInItsPlace) {
  Stage stage(with_placed());
  stage.run(0.3);
  EXPECT_EQ(stage.count(EventKind::placed), 0);
  stage.state->bodies[1].X_WB.p = Vec3(0.05, 0, 0);
  stage.run(0.15);
  EXPECT_EQ(stage.count(EventKind::placed), 0) << "on its way";
  stage.run(0.5);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::placed, &event), 1);
  EXPECT_EQ(event.subject, 0u);
  EXPECT_EQ(event.object, 1u);
  EXPECT_EQ(stage.value("DONE.placed"), 1);
}

TEST(Placed, WatchesASnapOnly) {
  state::WorldDescription world = with_placed();
  world.agents[0].parameters["snap"] = text({"HINGE"});
  EXPECT_THAT(error_of(world), is_error(ErrorCode::invalid_value, line_of("snap"), {"'HINGE'", "geometry.hinge"}));
}

}  // namespace
}  // namespace mechane::agents::test
