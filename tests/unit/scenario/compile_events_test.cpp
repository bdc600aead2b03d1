// X3D's nodes that send events: what is refused, what is left out, and what quantities may name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

Outcome compile_scene(const std::string& scene) {
  return compile_text("<X3D version='4.0' profile='Full'><Scene>\n" + scene + "</Scene></X3D>");
}

constexpr const char* kClock = "<TimeSensor DEF='T' loop='true'/>\n";
constexpr const char* kMover = "<Transform DEF='M'><Shape><Box/></Shape></Transform>\n";

std::string routed(const std::string& from, const std::string& from_field, const std::string& to,
                   const std::string& to_field) {
  return fmt::format("<ROUTE fromNode='{}' fromField='{}' toNode='{}' toField='{}'/>\n", from, from_field, to,
                     to_field);
}

struct EventSlip {
  std::string scene;
  int line;
  ErrorCode code;
  const char* says;
};

TEST(CompileEvents, RefusesWhatCannotRun) {
  using enum ErrorCode;
  const EventSlip slips[] = {
      {kClock + std::string(kMover) + routed("T", "fraction_changed", "M", "translation"), 4, conflict,
       "'fraction_changed' is an SFFloat, and 'translation' an SFVec3f"},
      {kClock + std::string(kMover) + routed("T", "fracton_changed", "M", "translation"), 4, conflict,
       "did you mean 'fraction_changed'?"},
      {std::string(kClock) + routed("T", "isActive", "T", "fraction_changed"), 3, conflict, "does not receive"},
      {"<PositionInterpolator DEF='P' key='0 1' keyValue='0 0 0'/>", 2, conflict, "there are 2 keys, and 1 values"},
      {"<ScalarInterpolator key='0 1 0.5' keyValue='0 1 2'/>", 2, invalid_value, "the key 0.5 is less"},
      {"<ScalarInterpolator key='0 nan' keyValue='0 1'/>", 2, invalid_value, "nan"},
      {"<PositionDamper tau='-1'/>", 2, invalid_value, "tau: -1"},
      {"<PositionDamper order='1000000'/>", 2, invalid_value, "order: 1000000"},
      {"<TimeSensor cycleInterval='0'/>", 2, invalid_value, "cycleInterval is 0 s"},
      {"<Transform scale='2 2 2'><ProximitySensor size='1 1 1'/></Transform>", 2, not_supported, "scaled"},
  };
  for (const EventSlip& slip : slips) {
    const Outcome outcome = compile_scene(slip.scene);
    EXPECT_FALSE(outcome.world) << slip.scene;
    const x3d::Problem problem = outcome.find(slip.code, slip.line, slip.says);
    EXPECT_EQ(problem.severity, x3d::Severity::error) << slip.scene;
    EXPECT_FALSE(problem.remedy.empty()) << slip.scene;
  }
}

TEST(CompileEvents, CapsCounts) {
  std::string many;
  for (std::size_t i = 0; i <= state::kMostEventNodes; ++i)
    many += "<BooleanToggle/>\n";
  static_cast<void>(compile_scene(many).find(ErrorCode::too_large, kAnyLine, "nodes"));
  many = "<BooleanToggle DEF='A'/><BooleanToggle DEF='B'/>";
  for (std::size_t i = 0; i <= state::kMostEventRoutes; ++i)
    many += routed("A", "toggle", "B", "set_boolean");
  static_cast<void>(compile_scene(many).find(ErrorCode::too_large, kAnyLine, "ROUTEs"));
  std::string bodies = "<RigidBodyCollection>", members;
  for (int i = 0; i < 40; ++i) {
    bodies += fmt::format(
        "<RigidBody containerField='bodies'><CollidableShape DEF='C{}' containerField='geometry'><Shape "
        "containerField='shape'><Box/></Shape></CollidableShape></RigidBody>",
        i);
    members += fmt::format("<CollidableShape USE='C{}' containerField='collidables'/>", i);
  }
  static_cast<void>(compile_scene(bodies +
                                  "</RigidBodyCollection><CollisionSensor><CollisionCollection "
                                  "containerField='collider'>" +
                                  members + "</CollisionCollection></CollisionSensor>")
                        .find(ErrorCode::too_large, kAnyLine, "500 pairs"));
}

TEST(CompileEvents, KeepsWhatLeadsToSomething) {
  // P drives a Text's group, which is not drawn; Q drives a Transform; a body that is free is moved by forces.
  const Outcome outcome = compile_scene(
      kClock + std::string(kMover) +
      "<PositionInterpolator DEF='P'/><PositionInterpolator DEF='Q'/><Transform DEF='EMPTY'/>\n"
      "<RigidBodyCollection><RigidBody DEF='FREE'/></RigidBodyCollection>\n" +
      routed("T", "fraction_changed", "P", "set_fraction") + routed("T", "fraction_changed", "Q", "set_fraction") +
      routed("P", "value_changed", "EMPTY", "translation") + routed("Q", "value_changed", "M", "translation") +
      routed("Q", "value_changed", "FREE", "position"));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  const state::EventDescription& events = outcome.world->events;
  ASSERT_EQ(events.nodes.size(), 3U);
  EXPECT_EQ(events.nodes[0].name, "T");
  EXPECT_EQ(events.nodes[2].name, "Q");
  EXPECT_EQ(events.routes.size(), 2U);
  EXPECT_EQ(outcome.find(ErrorCode::not_supported, 4, "not simulated").node, "PositionInterpolator P");
  static_cast<void>(outcome.find(ErrorCode::not_supported, 6, "(and 2 more ROUTE)"));
}

TEST(CompileEvents, QuantitiesMayNameThem) {
  const auto with = [](const std::string& source) {
    return compile_text(with_edits({{"</Scene>", std::string(kClock) + "<PositionDamper DEF='D'/></Scene>"},
                                    {"'\"PUMP.basin_l\"'", "'\"" + source + "\"'"}}));
  };
  for (const char* source : {"T.fraction_changed", "D.value_changed.y"}) {
    const Outcome outcome = with(source);
    for (const x3d::Problem& problem : outcome.problems)
      EXPECT_TRUE(problem.severity != x3d::Severity::error || problem.code == ErrorCode::conflict) << problem.what;
  }
  static_cast<void>(with("D.value_changed").find(ErrorCode::unknown_name, kAnyLine, "has no value 'value_changed'"));
}

}  // namespace
}  // namespace mechane::scenario
