#include "tests/unit/agents/stage.hpp"

namespace mechane::agents::test {
namespace {

using state::EventKind;

/// Parts P0, P1, P2 with snaps S0, S1, S2 at 0, 1 and 2 m; the graph is written last.
state::WorldDescription with_parts(std::map<std::string, state::Parameter> parameters = {}) {
  state::WorldDescription world;
  for (int i = 0; i < 3; ++i) {
    state::BodyDescription body;
    body.name = "P" + std::to_string(i);
    body.X_WB.p = Vec3(i, 5, 0);
    world.bodies.push_back(body);
    world.agents.push_back({"S" + std::to_string(i),
                            "geometry.snap",
                            {{"object", text({body.name})},
                             {"position", number({static_cast<double>(i), 0, 0})},
                             {"tolerance", number({0.1, 0.2})}},
                            i});
  }
  parameters.try_emplace("parts", text({"S0", "S1", "S2"}));
  world.agents.push_back({"BUILD", "simulation.assembled", std::move(parameters), 8});
  return world;
}

void bring(Stage& stage, std::size_t part) {
  stage.state->bodies[part].X_WB.p = Vec3(static_cast<double>(part), 0.05, 0);
}
void take_away(Stage& stage, std::size_t part) {
  stage.state->bodies[part].X_WB.p = Vec3(static_cast<double>(part), 5, 0);
}

TEST(Assembled, TakesPartsInTheirOrderOnly) {
  Stage stage(with_parts());
  stage.run(0.1);
  EXPECT_EQ(stage.value("BUILD.next"), 0);
  bring(stage, 1);
  stage.run(0.5);
  EXPECT_EQ(stage.value("S1.placed"), 0) << "it is not its turn";
  EXPECT_TRUE(stage.state->bodies[1].movable);
  state::Event event;
  EXPECT_EQ(stage.count(EventKind::part_refused, &event), 1) << "said once";
  EXPECT_EQ(event.object, 1u);
  EXPECT_EQ(stage.value("BUILD.refused"), 1);
  take_away(stage, 1);
  bring(stage, 0);
  stage.run(0.5);
  EXPECT_EQ(stage.value("BUILD.placed"), 1);
  EXPECT_EQ(stage.value("BUILD.next"), 1);
  for (const std::size_t part : {1u, 2u}) {
    bring(stage, part);
    stage.run(0.5);
  }
  EXPECT_EQ(stage.value("BUILD.complete"), 1);
  EXPECT_EQ(stage.count(EventKind::assembled), 1);
  EXPECT_EQ(stage.count(EventKind::part_refused), 1);
}

TEST(Assembled, AGraphLeavesAChoice) {
  Stage stage(with_parts({{"order", text({"S2 before S0", "S2 before S1"})}}));
  bring(stage, 0);
  stage.run(0.4);
  EXPECT_EQ(stage.value("S0.placed"), 0);
  for (const std::size_t part : {2u, 1u}) {
    bring(stage, part);
    stage.run(0.4);
  }
  EXPECT_EQ(stage.value("BUILD.complete"), 1) << "the first, which waited at its place, was taken when its turn came";
}

TEST(Assembled, WhileOffLeavesTheSnapsAlone) {
  Stage stage(with_parts());
  stage.state->agent_enabled[3] = 0;
  stage.state->agent_enabled[2] = 1;
  bring(stage, 2);
  stage.run(0.5);
  EXPECT_EQ(stage.value("S2.placed"), 1);
}

TEST(Assembled, RefusesWhatCannotBe) {
  const auto with = [](const char* parameter, std::initializer_list<std::string> values) {
    return error_of(with_parts({{parameter, text(values)}}));
  };
  EXPECT_THAT(with("order", {"S0 before S1", "S1 before S0"}), is_error(ErrorCode::conflict, line_of("order")));
  EXPECT_THAT(with("order", {"S0 after S1"}),
              is_error(ErrorCode::invalid_value, line_of("order"), {"'S0 after S1'", "ONE before OTHER"}));
  EXPECT_THAT(with("order", {"S0 before S7"}), is_error(ErrorCode::unknown_name, line_of("order"), {"'S0 before S7'"}));
  EXPECT_THAT(with("parts", {"S0", "S0"}), is_error(ErrorCode::duplicate, line_of("parts"), {"'S0'"}));
  EXPECT_THAT(with("parts", {"BUILD"}),
              is_error(ErrorCode::invalid_value, line_of("parts"), {"'BUILD'", "geometry.snap"}));
  EXPECT_THAT(with("parts", {}), is_error(ErrorCode::missing, line_of("parts")));
}

}  // namespace
}  // namespace mechane::agents::test
