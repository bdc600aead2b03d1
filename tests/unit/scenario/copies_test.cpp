// Many bodies of one RigidBody: names, places, who may name them, and what is refused.
#include "server/scenario/copies.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

using enum ErrorCode;

std::string number(const std::string& key, const std::string& value) {
  return "\n<MetadataDouble containerField='value' name='" + key + "' value='" + value + "'/>";
}

std::string body(const std::string& def, const std::string& attributes, const std::string& keys) {
  return "\n<RigidBody DEF='" + def + "' containerField='bodies' inertia='1 0 0 0 1 0 0 0 1' " + attributes +
         ">\n<MetadataSet containerField='metadata' name='mechane:body'>\n" + keys +
         "</MetadataSet>\n<CollidableShape containerField='geometry'><Shape containerField='shape'><Sphere "
         "radius='0.01'/>"
         "</Shape></CollidableShape></RigidBody>";
}

std::string coins(const std::string& keys, const std::string& attributes = "position='1 2 3'") {
  return body("COIN", attributes, "<MetadataSet containerField='value' name='copies'>" + keys + "\n</MetadataSet>");
}

const std::string kRow = number("count", "3") + number("step", "0.5 0 0");

/// The shipped file, with bodies after its own, and more in its agents, quantities and the step 'fill'.
std::string with(const std::string& bodies, const std::string& agents = {}, const std::string& quantities = {},
                 const std::string& fill = {}) {
  const std::string agents_set = "<MetadataSet containerField='value' name='agents'>";
  const std::string quantities_set = "<MetadataSet containerField='value' name='quantities'>";
  const std::string fill_set = "<MetadataSet containerField='value' name='fill'>";
  return with_edits({{agents_set, agents_set + agents},
                     {quantities_set, quantities_set + quantities},
                     {fill_set, fill_set + fill},
                     {"</RigidBodyCollection>", bodies + "\n</RigidBodyCollection>"}});
}

Vec3 place(const Outcome& outcome, const std::string& name) {
  const BodyId id = outcome.world->find_body(name);
  return id ? outcome.world->bodies[id.index()].X_WB.p : Vec3::Constant(1e9);
}

/// The world of the shipped file with these copies, without problems.
Outcome good(const std::string& keys) {
  Outcome outcome = compile_text(with(coins(keys)));
  EXPECT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems.front());
  return outcome;
}

TEST(Copies, StandInARow) {
  const Outcome outcome = good(kRow);
  EXPECT_FALSE(outcome.world->find_body("COIN"));
  EXPECT_FALSE(outcome.world->find_body("COIN-4"));
  for (int i = 0; i < 3; ++i)
    EXPECT_EQ(place(outcome, fmt::format("COIN-{}", i + 1)), Vec3(1 + 0.5 * i, 2, 3));
}

TEST(Copies, StandInAGridRowByRow) {
  const Outcome outcome =
      good(number("count", "5") + number("step", "0.5 0 0") + number("columns", "2") + number("rowStep", "0 0 0.25"));
  EXPECT_EQ(place(outcome, "COIN-2"), Vec3(1.5, 2, 3));
  EXPECT_EQ(place(outcome, "COIN-3"), Vec3(1, 2, 3.25));
  EXPECT_EQ(place(outcome, "COIN-5"), Vec3(1, 2, 3.5)) << "the last row is not full";
}

TEST(Copies, StandInARingAndTurnWithIt) {
  const Outcome outcome = good(number("count", "4") + number("ringCentre", "0 2 3"));
  const Vec3 wanted[] = {{1, 2, 3}, {0, 2, 2}, {-1, 2, 3}, {0, 2, 4}};
  for (int i = 0; i < 4; ++i) {
    const state::BodyDescription& coin =
        outcome.world->bodies[outcome.world->find_body(fmt::format("COIN-{}", i + 1)).index()];
    EXPECT_LT((coin.X_WB.p - wanted[i]).norm(), 1e-12) << i;
    EXPECT_LT((coin.X_WB.rotate(Vec3::UnitX()) - (wanted[i] - Vec3(0, 2, 3))).norm(), 1e-12) << "it faces outwards";
  }
  const Outcome upright = good(number("count", "4") + number("ringCentre", "0 2 3") + number("ringAxis", "0 0 2"));
  EXPECT_LT((place(upright, "COIN-2") - Vec3(0, 3, 3)).norm(), 1e-12);
}

TEST(Copies, StandAsTheyAreListed) {
  const Outcome outcome = good(number("positions", "0 1 0  0.5 1 0  0 1 2"));
  EXPECT_EQ(place(outcome, "COIN-1"), Vec3(0, 1, 0)) << "the list counts for the first, too";
  EXPECT_EQ(place(outcome, "COIN-3"), Vec3(0, 1, 2));
  EXPECT_FALSE(outcome.world->find_body("COIN-4"));
}

TEST(Copies, AreNamedOneByOneOrAllAtOnce) {
  const std::string text = with(
      coins(kRow),
      "<MetadataSet containerField='value' name='TAKE'><MetadataString containerField='value' name='type' "
      "value='\"simulation.grasp\"'/><MetadataString containerField='value' name='bodies' value='\"INNER\" "
      "\"COIN-*\"'/>"
      "</MetadataSet>",
      "<MetadataString containerField='value' name='speed_of_2' value='\"COIN-2.speed\"'/>",
      "<MetadataSet containerField='value' name='object:COIN-*'><MetadataBoolean containerField='value' name='visible' "
      "value='false'/></MetadataSet>"
      "<MetadataSet containerField='value' name='object:COIN-2'><MetadataBoolean containerField='value' name='movable' "
      "value='false'/></MetadataSet>");
  const Outcome outcome = compile_text(text);
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  const state::ComponentDescription& take = outcome.world->agents[outcome.world->find_agent("TAKE").index()];
  EXPECT_EQ(*take.written<std::vector<std::string>>("bodies"),
            (std::vector<std::string>{"INNER", "COIN-1", "COIN-2", "COIN-3"}));
  EXPECT_TRUE(outcome.world->find_quantity("speed_of_2"));
  const state::StepDescription& fill = outcome.world->steps[outcome.world->find_step("fill").index()];
  ASSERT_EQ(fill.bodies.size(), 3u);
  for (const state::BodyOverride& change : fill.bodies) {
    EXPECT_EQ(change.visible, std::optional(false));
    EXPECT_EQ(change.movable.has_value(), change.body == outcome.world->find_body("COIN-2"));
  }
}

TEST(Copies, WhoNamesAllWhereOneIsWantedIsTold) {
  const auto refused = [](const std::string& text, const std::string& at) {
    const Outcome outcome = compile_text(text);
    EXPECT_FALSE(outcome.world);
    EXPECT_EQ(outcome.problems.size(), 1u) << at;
    EXPECT_NE(outcome.find(unknown_name, line_of(text, at), "3 bodies").remedy.find("COIN-1 to COIN-3"),
              std::string::npos);
  };
  const std::string quantity = "\n<MetadataString containerField='value' name='s' value='\"COIN.speed\"'/>";
  refused(with(coins(kRow), {}, quantity), "\"COIN.speed\"");
  const auto object = [](const std::string& name) {
    return "\n<MetadataSet containerField='value' name='object:" + name +
           "'><MetadataBoolean containerField='value' name='visible' value='false'/></MetadataSet>";
  };
  refused(with(coins(kRow), {}, {}, object("COIN")), "object:COIN");
  const std::string grasp =
      "\n<MetadataSet containerField='value' name='TAKE'><MetadataString containerField='value' name='type' "
      "value='\"simulation.grasp\"'/>\n<MetadataString containerField='value' name='bodies' value='\"COIN\"'/>"
      "</MetadataSet>";
  refused(with(coins(kRow), grasp), "value='\"COIN\"'");
  // One that does not exist.
  const std::string none = with(coins(kRow), {}, {}, object("COIN-4"));
  EXPECT_NE(compile_text(none).find(unknown_name, line_of(none, "object:COIN-4"), "'COIN-4'").remedy.find("COIN-"),
            std::string::npos);
}

TEST(Copies, AStepDoesNotPutAllAtOnePlace) {
  const std::string text = with(
      coins(kRow), {}, {},
      "\n<MetadataSet containerField='value' name='object:COIN-*'>" + number("position", "0 1 0") + "</MetadataSet>");
  EXPECT_NE(compile_text(text).find(conflict, line_of(text, "object:COIN-*"), "one place").remedy.find("object:COIN-1"),
            std::string::npos);
}

TEST(Copies, WhatTheirPlacesLackOrSayTwiceIsAnError) {
  const auto refused = [](ErrorCode code, const std::string& keys, const std::string& at, const std::string& word) {
    const std::string text = with(coins(keys));
    EXPECT_EQ(compile_text(text).find(code, line_of(text, at), word).severity, x3d::Severity::error) << keys;
  };
  const std::string copies = "name='copies'";
  const std::string count = number("count", "3"), step = number("step", "0.5 0 0");
  refused(missing, step, copies, "'count' is missing");
  refused(missing, count, copies, "where the copies stand");
  refused(invalid_value, number("count", "1") + step, "name='count'", "out of its range");
  refused(invalid_value, number("count", "201") + step, "name='count'", "out of its range");
  refused(invalid_value, number("count", "2.5") + step, "name='count'", "whole number");
  refused(conflict, kRow + number("ringCentre", "0 0 0"), "name='ringCentre'", "step and ringCentre");
  refused(conflict, kRow + number("columns", "2"), "name='columns'", "nothing without rowStep");
  refused(conflict, kRow + number("rowStep", "0 0 1"), "name='rowStep'", "nothing without columns");
  refused(conflict, kRow + number("ringAxis", "0 0 1"), "name='ringAxis'", "nothing without ringCentre");
  refused(invalid_value, kRow + number("columns", "1.5") + number("rowStep", "0 0 1"), "name='columns'",
          "whole number");
  refused(invalid_value, number("positions", "0 1 0 0.5 1"), "name='positions'", "5 numbers");
  refused(invalid_value, number("positions", "0 1 0"), "name='positions'", "3 numbers");
  refused(conflict, count + number("positions", "0 1 0 0.5 1 0"), "name='count'", "places for 2");
  refused(conflict, count + number("step", "0 0 0"), copies, "COIN-1 and COIN-2 stand at the same place");
  refused(conflict, count + number("ringCentre", "1 5 3"), copies, "same place");
  refused(conflict, number("positions", "0 1 0  1 1 0  0 1 0"), copies, "COIN-1 and COIN-3");
  refused(invalid_value, count + number("ringCentre", "0 0 0") + number("ringAxis", "0 0 0"), "name='ringAxis'",
          "no length");
  refused(invalid_value, number("count", "200") + number("step", "100 0 0"), copies, "farther than");
  refused(unknown_name, count + number("stepp", "1 0 0"), "name='stepp'", "stepp");
}

TEST(Copies, WhatCannotTellOneFromAnotherIsRefused) {
  const std::string joint =
      "\n<SliderJoint DEF='RAIL' containerField='joints' axis='0 1 0'>\n<RigidBody containerField='body1' "
      "USE='OUTER'/>\n"
      "<RigidBody containerField='body2' USE='COIN'/></SliderJoint>";
  const std::string joined = with(coins(kRow) + joint);
  const Outcome outcome = compile_text(joined);
  EXPECT_EQ(outcome.problems.size(), 1u);
  static_cast<void>(outcome.find(conflict, line_of(joined, "USE='COIN'"), "a joint joins one"));

  const std::string routed = with(
      coins(kRow, "fixed='true'") +
      "\n<TimeSensor DEF='CLOCK' loop='true'/>\n<PositionInterpolator DEF='WAY' key='0 1' keyValue='0 0 0 0 1 0'/>\n"
      "<ROUTE fromNode='CLOCK' fromField='fraction_changed' toNode='WAY' toField='set_fraction'/>\n"
      "<ROUTE fromNode='WAY' fromField='value_changed' toNode='COIN' toField='set_position'/>");
  static_cast<void>(compile_text(routed).find(conflict, line_of(routed, "DEF='COIN'"), "a ROUTE names COIN"));

  const std::string agent = "<MetadataSet containerField='value' name='copies'>" + kRow + "\n</MetadataSet>";
  std::string on_itself = with(body("COIN", "position='1 2 3'", agent));
  replace_first(on_itself, "<MetadataSet containerField='metadata' name='mechane:body'>\n" + agent,
                "<MetadataSet containerField='metadata' name='mechane'><MetadataSet containerField='value' "
                "name='mechane:body'>\n" +
                    agent +
                    "</MetadataSet><MetadataSet containerField='value' name='mechane:agent'><MetadataString "
                    "containerField='value' name='type' value='\"geometry.fixed\"'/></MetadataSet>");
  static_cast<void>(compile_text(on_itself).find(conflict, line_of(on_itself, "DEF='COIN'"), "acts on one"));

  const std::string twice = with(coins(kRow) + body("COIN-2", "position='5 2 3'", ""));
  static_cast<void>(compile_text(twice).find(duplicate, line_of(twice, "name='copies'"), "COIN-2"));
}

TEST(Copies, AreKnownFromTheFileAlone) {
  x3d::Problems problems("");
  const auto names = [&](const std::string& keys) {
    const auto document = x3d::read_document(with(coins(keys)), shipped_file(), problems);
    return copies_in(*document, document->find_def("COIN"));
  };
  EXPECT_EQ(names(kRow), (std::vector<std::string>{"COIN-1", "COIN-2", "COIN-3"}));
  EXPECT_EQ(names(number("positions", "0 1 0 0.5 1 0")), (std::vector<std::string>{"COIN-1", "COIN-2"}));
  EXPECT_TRUE(names(number("count", "1e9")).empty()) << "a faulty count";
  const auto document = x3d::read_document(text_of(shipped_file()), shipped_file(), problems);
  EXPECT_TRUE(copies_in(*document, document->find_def("INNER")).empty());
}

}  // namespace
}  // namespace mechane::scenario
