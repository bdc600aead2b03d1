// What an author says of a quantity's gauge: its label and its range.
#include <gtest/gtest.h>

#include "server/scenario/facts.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/scenario/scenario_fixture.hpp"

namespace mechane::scenario {
namespace {

using x3d::Severity;

const std::string kBasin = "name='source' value='\"PUMP.basin_l\"'/>";

/// The shipped file, with more keys in its quantity `basin`, for which its step `fill` waits: more than 15.
std::string with_basin(const std::string& keys, Edits edits = {}) {
  edits.emplace_back(kBasin, kBasin + "\n" + keys);
  return with_edits(edits);
}

std::string label(const std::string& language, const std::string& words) {
  return "<MetadataString containerField='value' name='label." + language + "' value='\"" + words + "\"'/>";
}

std::string texts(const std::string& inner) {
  return "<MetadataSet containerField='value' name='text'>" + inner + "</MetadataSet>\n";
}

std::string bound(const std::string& key, double value) {
  return "<MetadataDouble containerField='value' name='" + key + "' value='" + std::to_string(value) + "'/>\n";
}

const std::string kBothLabels = texts(label("el", "Νερό στη δεξαμενή") + label("en", "Water in the basin"));

TEST(Quantities, HaveALabelAndARange) {
  const Outcome outcome = compile_text(with_basin(kBothLabels + bound("least", -5) + bound("greatest", 20)));
  ASSERT_TRUE(outcome.world) << outcome.world.error().to_string();
  EXPECT_TRUE(outcome.problems.empty()) << to_string(outcome.problems.front());
  const state::QuantityDescription& basin = outcome.world->quantities[outcome.world->find_quantity("basin").index()];
  EXPECT_EQ(basin.label.at("el"), "Νερό στη δεξαμενή");
  EXPECT_EQ(basin.label.at("en"), "Water in the basin");
  ASSERT_TRUE(basin.range);
  EXPECT_EQ(basin.range->least, -5);
  EXPECT_EQ(basin.range->greatest, 20);
  const state::QuantityDescription& speed = outcome.world->quantities[outcome.world->find_quantity("speed").index()];
  EXPECT_TRUE(speed.label.empty());
  EXPECT_FALSE(speed.range);
}

TEST(Quantities, ALabelThatIsMissingInALanguageIsToldAsOtherTextsAre) {
  const std::string text = with_basin(texts(label("en", "Water in the basin")));
  expect_one_warning(text, "name='basin'>", ErrorCode::missing, "missing in: el");
  expect_one_warning(with_basin(texts(label("el", "Νερό") + label("en", "Water") + label("fr", "Eau"))), "label.fr",
                     ErrorCode::unknown_name, "'fr'");
}

TEST(Quantities, ALabelIsAWordingOfTheCatalogue) {
  const test::ScratchFolder folder(test::folder_in_memory());
  const auto file = folder.path() / "one.x3d";
  const std::string quantity =
      "<MetadataSet name='q' containerField='value'>"
      "<MetadataString name='source' containerField='value' value='\"BALL.speed\"'/>" +
      texts(label("en", "Speed")) + "</MetadataSet>";
  std::ofstream(file)
      << "<X3D version='4.0' profile='Full'><Scene><WorldInfo><MetadataSet containerField='metadata' "
         "name='mechane:scenario'><MetadataInteger containerField='value' name='format' value='1'/>"
         "<MetadataString containerField='value' name='id' value='\"one\"'/>"
         "<MetadataString containerField='value' name='languages' value='\"el\" \"en\"'/>"
         "<MetadataSet containerField='value' name='quantities'>"
      << quantity
      << "</MetadataSet><MetadataSet containerField='value' name='activities'><MetadataSet containerField='value' "
         "name='a'><MetadataSet containerField='value' name='steps'><MetadataSet containerField='value' "
         "name='s'/></MetadataSet></MetadataSet></MetadataSet></MetadataSet></WorldInfo>"
         "<RigidBodyCollection><RigidBody DEF='BALL' containerField='bodies'/></RigidBodyCollection>"
         "</Scene></X3D>";
  const auto facts = read_facts(file);
  ASSERT_TRUE(facts) << facts.error().to_string();
  EXPECT_EQ(facts->wordings.at("quantity q, label"), std::vector<std::string>{"en"});
}

TEST(Quantities, ARangeThatIsReversedOrHasNoEndIsAnError) {
  const std::string reversed = with_basin(bound("least", 20) + bound("greatest", 5));
  EXPECT_EQ(compile_text(reversed)
                .find(ErrorCode::conflict, line_of(reversed, "name='greatest'"), "20, is not below its greatest, 5")
                .severity,
            Severity::error);
  const std::string empty = with_basin(bound("least", 5) + bound("greatest", 5));
  EXPECT_EQ(compile_text(empty).find(ErrorCode::conflict, line_of(empty, "name='greatest'")).severity, Severity::error);
  const std::string open = with_basin(bound("least", 5));
  EXPECT_EQ(compile_text(open).find(ErrorCode::missing, line_of(open, "name='least'"), "no end").severity,
            Severity::error);
  // Without a least it begins at 0.
  expect_nothing(with_basin(bound("greatest", 20)));
}

TEST(Quantities, ARangeThatNoDisplayShowsIsToldToItsAuthor) {
  const std::string unit = kBasin + "\n            <MetadataString containerField='value' name='unit' value='\"l\"'/>";
  const std::string other = kBasin + "\n<MetadataString containerField='value' name='unit' value='\"\"'/>";
  const std::string unseen = with_edits({{unit, other + bound("greatest", 20)}});
  expect_one_warning(unseen, "name='greatest'", ErrorCode::conflict, "not seen");
  expect_nothing(with_edits({{unit, other + kBothLabels + bound("greatest", 20)}}));
}

TEST(Quantities, AGoalOutsideTheRangeIsToldToItsAuthor) {
  const std::string goal = "name='value' value='15'/>";
  expect_one_warning(with_basin(bound("greatest", 10)), goal, ErrorCode::conflict, "goal 15 is outside");
  expect_one_warning(with_basin(bound("least", 16) + bound("greatest", 20)), goal, ErrorCode::conflict, "16 to 20");
  expect_nothing(with_basin(bound("least", 15) + bound("greatest", 20)));
  // What is compared for equality, and what a second trigger waits for, is not marked.
  expect_nothing(
      with_basin(bound("greatest", 10), {{"<MetadataSet containerField='value' name='fill'>",
                                          "<MetadataSet containerField='value' name='fill'>\n"
                                          "<MetadataSet containerField='value' name='trigger:0'>"
                                          "<MetadataString containerField='value' name='quantity' value='\"turns\"'/>"
                                          "<MetadataString containerField='value' name='op' value='\"=\"'/>"
                                          "<MetadataDouble containerField='value' name='value' value='900'/>"
                                          "</MetadataSet>"}}));
}

TEST(Quantities, AMisspeltKeyOfAGaugeIsAnError) {
  const std::string text = with_basin(bound("greatst", 20));
  EXPECT_EQ(compile_text(text).find(ErrorCode::unknown_name, line_of(text, "greatst"), "greatst").severity,
            Severity::error);
}

}  // namespace
}  // namespace mechane::scenario
