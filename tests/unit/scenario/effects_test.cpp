// Effects and close-ups of a scenario: what is read, and the faults.
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

TEST(Effects, FaultsOfARiverHaveCodeLineAndRemedy) {
  const auto expect_problem = [](const std::string& from, const std::string& to, ErrorCode code, const std::string& at,
                                 const std::string& name, x3d::Severity severity) {
    const std::string text = edited(from, to);
    const x3d::Problem problem = compile_text(text).find(code, line_of(text, at), name);
    EXPECT_EQ(problem.severity, severity) << to_string(problem);
  };
  const std::string node = "<MetadataString containerField='value' name='node' value='\"WATER_RIVER\"'/>";
  const std::string way = "<MetadataDouble containerField='value' name='direction' value='0 0 1'/>";
  const std::string flow = "name='kind' value='\"flow\"'";
  const x3d::Severity error = x3d::Severity::error;
  expect_problem("'\"WATER_RIVER\"'", "'\"SCENE\"'", ErrorCode::conflict, "'\"SCENE\"'", "'SCENE'", error);
  expect_problem(way, "", ErrorCode::invalid_value, flow, "direction", error);
  expect_problem(way, "<MetadataDouble containerField='value' name='direction' value='0 1 0'/>",
                 ErrorCode::invalid_value, "value='0 1 0'", "direction", error);
  expect_problem(node, node + "<MetadataString containerField='value' name='quantity' value='\"flow\"'/>",
                 ErrorCode::conflict, "\"WATER_RIVER\"", "'quantity'", x3d::Severity::warning);
  expect_problem("<MetadataString containerField='value' " + flow + "/>",
                 "<MetadataString containerField='value' name='kind' value='\"level\"'/>", ErrorCode::missing,
                 "name='RIVER'>", "quantity", error);
}

TEST(Quantities, AnUnknownUnitIsWarnedOf) {
  const std::string text = edited("'\"rpm\"'", "'\"rmp\"'");
  const x3d::Problem slip =
      compile_text(text).find(ErrorCode::unknown_name, line_of(text, "'\"rmp\"'"), "did you mean 'rpm'?");
  EXPECT_EQ(slip.severity, x3d::Severity::warning);
}

/// The shipped file with a click in front of its effects.
std::string with_click(const std::string& body) {
  const std::string begin = "<MetadataSet containerField='value' name='effects'>";
  return edited(begin, begin +
                           "<MetadataSet containerField='value' name='TOOTH'>"
                           "<MetadataString containerField='value' name='kind' value='\"touch.click\"'/>"
                           "<MetadataString containerField='value' name='quantity' value='\"turns\"'/>"
                           "<MetadataDouble containerField='value' name='full' value='0.25'/>"
                           "<MetadataDouble containerField='value' name='force' value='0.8'/>" +
                           body + "</MetadataSet>");
}

TEST(Effects, AClickIsFeltInABody) {
  const auto compiled =
      compile_text(with_click("<MetadataString containerField='value' name='body' value='\"INNER\"'/>"));
  ASSERT_TRUE(compiled.world);
  const state::EffectDescription& click = compiled.world->effects.front();
  EXPECT_TRUE(click.felt);
  EXPECT_EQ(click.body, compiled.world->find_body("INNER"));
  EXPECT_DOUBLE_EQ(click.full, 0.25);
  EXPECT_DOUBLE_EQ(click.force_n, 0.8);
  const std::string nowhere = with_click("");
  EXPECT_EQ(compile_text(nowhere).find(ErrorCode::missing, line_of(nowhere, "name='TOOTH'>"), "body").severity,
            x3d::Severity::error);
}

TEST(Effects, FaultsHaveCodeLineAndRemedy) {
  const auto expect_error = [](const std::string& text, ErrorCode code, const std::string& at,
                               const std::string& name) {
    const x3d::Problem problem = compile_text(text).find(code, line_of(text, at), name);
    EXPECT_EQ(problem.severity, x3d::Severity::error) << to_string(problem);
  };
  using enum ErrorCode;
  expect_error(edited("'\"stream\"'", "'\"streem\"'"), invalid_value, "'\"streem\"'", "'streem'");
  const std::string body = "<MetadataString containerField='value' name='body' value=";
  expect_error(edited(body + "'\"OUTER\"'/>\n            <MetadataDouble containerField='value' name='point'",
                      body + "'\"OTER\"'/>\n            <MetadataDouble containerField='value' name='point'"),
               unknown_name, "'\"OTER\"'", "did you mean 'OUTER'?");
  const std::string flow =
      "<MetadataString containerField='value' name='quantity' value='\"flow\"'/>\n            "
      "<MetadataDouble containerField='value' name='full' value='3'/>";
  const auto driven_by = [&](const std::string& quantity) {
    return edited(flow,
                  "<MetadataString containerField='value' class='here' name='quantity' value='\"" + quantity + "\"'/>");
  };
  expect_error(driven_by("flw"), unknown_name, "class='here'", "did you mean 'flow'?");
  expect_error(driven_by("speed"), conflict, "class='here'", "'speed' has the unit 'rpm'");
  expect_error(edited("value='-0.5083 0 0.8612'", "value='0 0 0' class='here'"), invalid_value, "class='here'",
               "direction");
  expect_error(edited("<MetadataString containerField='value' name='node' value='\"WATER_BASIN\"'/>", ""),
               ErrorCode::missing, "name='BASIN_WATER'>", "key node");
  expect_error(edited("'\"BASIN_VIEW\"'", "'\"BASIN_VIW\"'"), unknown_name, "'\"BASIN_VIW\"'",
               "did you mean 'BASIN_VIEW'?");
}

}  // namespace
}  // namespace mechane::scenario
