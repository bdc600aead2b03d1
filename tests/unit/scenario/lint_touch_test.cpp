// Warnings of surfaces that change nothing or that no hand feels, and of pulls that no hand feels or withstands.
#include <gtest/gtest.h>

#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

std::string wet(const std::string& keys) {
  return "<MetadataSet containerField='value' name='WET'>\n<MetadataString containerField='value' name='type' "
         "value='\"touch.surface\"'/>\n<MetadataString containerField='value' name='object' value='\"INNER\"' "
         "class='wet'/>\n" +
         keys + "</MetadataSet>\n";
}
const std::string kViscous = "<MetadataDouble containerField='value' name='viscosity' value='1'/>\n";
const std::string kTakeEnables = "value='\"CARRY\" \"SEAT\"'";

Edits with_surface(const std::string& keys, const std::string& enabled) {
  const std::string before = "<MetadataSet containerField='value' name='SEATED'>";
  return {{before, wet(keys) + before}, {kTakeEnables, "value='\"CARRY\" \"SEAT\"" + enabled + "'"}};
}

const std::pair<std::string, std::string> kUntouchable{
    "name='node' value='\"INNER\"'/>",
    "name='node' value='\"INNER\"'/><MetadataBoolean containerField='value' name='touchable' value='false'/>"};

TEST(LintTouch, ASurfaceThatChangesNothingIsNamed) {
  expect_nothing(with_edits(with_surface(kViscous, " \"WET\"")));
  const std::string at = "name='WET'>";
  expect_one_warning(with_edits(with_surface("", " \"WET\"")), at, ErrorCode::conflict, "it changes nothing");
  expect_one_warning(with_edits(with_surface(kViscous, "")), at, ErrorCode::conflict, "no step switches it");
  Edits untouchable = with_surface(kViscous, " \"WET\"");
  untouchable.push_back(kUntouchable);
  expect_one_warning(with_edits(untouchable), "class='wet'", ErrorCode::conflict, "no hand can touch 'INNER'");
  // On from the beginning, it is switched off later.
  Edits dries = with_surface(kViscous, "");
  const std::string seat = "<MetadataSet containerField='value' name='seat'>\n";
  dries.emplace_back(seat, seat + "<MetadataString containerField='value' name='disable' value='\"WET\"'/>\n");
  expect_nothing(with_edits(dries));
}

/// What the checker says of a pull of SEAT.
std::vector<std::string> of_pull(const std::string& pull_n, Edits edits = {}) {
  const std::string object = "name='object' value='\"INNER\"'/>";
  edits.emplace_back(object, object + "\n<MetadataDouble containerField='value' name='pull' value='" + pull_n + "'/>");
  const std::string text = with_edits(edits);
  std::vector<std::string> said;
  for (const x3d::Problem& problem : compile_text(text).problems) {
    if (problem.line != line_of(text, "name='pull'")) continue;
    EXPECT_EQ(problem.severity, x3d::Severity::warning);
    EXPECT_EQ(problem.node, "agent SEAT");
    said.push_back(problem.what);
  }
  return said;
}

std::string agents_of_take(const std::string& enable, const std::string& disable) {
  return "value='" + enable + "'/><MetadataString containerField='value' name='disable' value='" + disable + "'";
}

TEST(LintTouch, APullThatNoHandCanFeelIsNamed) {
  EXPECT_EQ(of_pull("1"), std::vector<std::string>());
  const std::vector<std::string> never{
      "the pull is never felt: in no step can a hand carry 'INNER' while 'SEAT' is on"};
  EXPECT_EQ(of_pull("1", {kUntouchable}), never);
  EXPECT_EQ(of_pull("1", {{"name='movable' value='true'", "name='movable' value='false'"}}), never);
  EXPECT_EQ(of_pull("1", {{"name='graspable' value='true'", "name='graspable' value='false'"}}), never);
  EXPECT_EQ(of_pull("1", {{kTakeEnables, agents_of_take("\"SEAT\"", "\"CARRY\"")}}), never);
  EXPECT_EQ(of_pull("0", {kUntouchable}), std::vector<std::string>()) << "a pull of 0 is no pull";
}

TEST(LintTouch, WhatEarlierStepsSwitchedCountsForAPull) {
  const std::string seat = "<MetadataSet containerField='value' name='seat'>\n";
  const std::string later = seat + "<MetadataString containerField='value' name='enable' value='\"SEAT\"'/>\n";
  EXPECT_EQ(of_pull("1", {{kTakeEnables, "value='\"CARRY\"'"}, {seat, later}}), std::vector<std::string>());
  const std::string too_late = later + "<MetadataString containerField='value' name='disable' value='\"CARRY\"'/>\n";
  EXPECT_EQ(of_pull("1", {{kTakeEnables, "value='\"CARRY\"'"}, {seat, too_late}}).size(), 1u);
}

TEST(LintTouch, APullThatTearsTheBodyOutOfTheHandIsNamed) {
  const auto limited = [&](const std::string& force_n) {
    return Edits{{"name='forceLimit' value='12'", "name='forceLimit' value='" + force_n + "'"}};
  };
  EXPECT_EQ(of_pull("4", limited("4.5")), std::vector<std::string>());
  EXPECT_EQ(
      of_pull("4", limited("3")),
      std::vector<std::string>{"the pull of 4 N tears 'INNER' out of the hand: the forceLimit of 'CARRY' is 3 N"});
}

}  // namespace
}  // namespace mechane::scenario
