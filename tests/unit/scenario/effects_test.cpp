// Effects and close-ups of a scenario: read, and faults said with a remedy.
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

TEST(Effects, AreReadFromTheShippedFile) {
  const state::WorldDescription world = *compile_text(text_of(shipped_file())).world;
  const auto spout =
      std::find_if(world.effects.begin(), world.effects.end(), [](const auto& e) { return e.kind == "stream"; });
  ASSERT_NE(spout, world.effects.end());
  EXPECT_EQ(spout->name, "SPOUT");
  EXPECT_EQ(spout->body, world.find_body("OUTER"));
  EXPECT_EQ(spout->quantity, world.find_quantity("flow"));
  EXPECT_NEAR(spout->direction_B.norm(), 1, 1e-12);
  EXPECT_NEAR(spout->p_BE.z(), 1.13, 1e-9);
  EXPECT_DOUBLE_EQ(spout->speed_m_per_s, 0.55);
  EXPECT_EQ(world.steps[world.find_step("fill").index()].detail, "BASIN_VIEW");
  ASSERT_EQ(world.viewpoints.size(), 2U);
  EXPECT_EQ(world.viewpoints[1].name, "BASIN_VIEW");
}

TEST(Effects, ARiverFlowsAndNothingDrivesIt) {
  const state::WorldDescription world = *compile_text(text_of(shipped_file())).world;
  const auto river =
      std::find_if(world.effects.begin(), world.effects.end(), [](const auto& e) { return e.kind == "flow"; });
  ASSERT_NE(river, world.effects.end());
  EXPECT_EQ(river->node, "WATER_RIVER");
  EXPECT_FALSE(river->quantity);
  EXPECT_DOUBLE_EQ(river->speed_m_per_s, 0.35);
  EXPECT_DOUBLE_EQ(river->direction_B.z(), 1);
}

TEST(Effects, FaultsOfARiverAreSaidWithTheirRemedy) {
  const auto expect_problem = [](const std::string& from, const std::string& to, const std::string& words,
                                 x3d::Severity severity) {
    const x3d::Problem problem = compile_text(edited(from, to)).find(words);
    EXPECT_EQ(problem.severity, severity) << to_string(problem);
    EXPECT_GT(problem.line, 0);
    EXPECT_FALSE(problem.remedy.empty());
  };
  const std::string node = "<MetadataString containerField='value' name='node' value='\"WATER_RIVER\"'/>";
  const std::string way = "<MetadataDouble containerField='value' name='direction' value='0 0 1'/>";
  expect_problem("'\"WATER_RIVER\"'", "'\"SCENE\"'", "node 'SCENE' is not water", x3d::Severity::error);
  expect_problem(way, "", "not along the water", x3d::Severity::error);
  expect_problem(way, "<MetadataDouble containerField='value' name='direction' value='0 1 0'/>", "not along the water",
                 x3d::Severity::error);
  expect_problem(node, node + "<MetadataString containerField='value' name='quantity' value='\"flow\"'/>",
                 "a flow effect does not use 'quantity'", x3d::Severity::warning);
  expect_problem("<MetadataString containerField='value' name='kind' value='\"flow\"'/>",
                 "<MetadataString containerField='value' name='kind' value='\"level\"'/>",
                 "names no quantity that drives it", x3d::Severity::error);
}

TEST(Quantities, AnUnknownUnitIsWarnedOf) {
  const x3d::Problem slip = compile_text(edited("'\"rpm\"'", "'\"rmp\"'")).find("did you mean 'rpm'?");
  EXPECT_EQ(slip.severity, x3d::Severity::warning);
}

TEST(Effects, FaultsAreSaidWithTheirRemedy) {
  const auto expect_error = [](const Outcome& outcome, const std::string& words) {
    const x3d::Problem problem = outcome.find(words);
    EXPECT_EQ(problem.severity, x3d::Severity::error) << to_string(problem);
    EXPECT_GT(problem.line, 0);
    EXPECT_FALSE(problem.remedy.empty());
  };
  expect_error(compile_text(edited("'\"stream\"'", "'\"streem\"'")), "'streem' is not one of: level flow stream");
  const std::string body = "<MetadataString containerField='value' name='body' value=";
  expect_error(
      compile_text(edited(body + "'\"OUTER\"'/>\n            <MetadataDouble containerField='value' name='point'",
                          body + "'\"OTER\"'/>\n            <MetadataDouble containerField='value' name='point'")),
      "did you mean 'OUTER'?");
  const std::string flow =
      "<MetadataString containerField='value' name='quantity' value='\"flow\"'/>\n            "
      "<MetadataDouble containerField='value' name='full' value='3'/>";
  const auto driven_by = [&](const std::string& quantity) {
    return edited(flow, "<MetadataString containerField='value' name='quantity' value='\"" + quantity + "\"'/>");
  };
  expect_error(compile_text(driven_by("flw")), "did you mean 'flow'?");
  expect_error(compile_text(driven_by("speed")), "a stream is driven by a flow, and 'speed' has the unit 'rpm'");
  expect_error(compile_text(edited("value='-0.5083 0 0.8612'", "value='0 0 0'")), "the direction has no length");
  expect_error(compile_text(edited("<MetadataString containerField='value' name='node' value='\"WATER_BASIN\"'/>", "")),
               "names no node that could rise");
  expect_error(compile_text(edited("'\"BASIN_VIEW\"'", "'\"BASIN_VIW\"'")), "did you mean 'BASIN_VIEW'?");
}

}  // namespace
}  // namespace mechane::scenario
