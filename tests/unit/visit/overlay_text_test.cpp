#include "client-sdk/visit/overlay_text.hpp"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "server/state/description.hpp"

namespace mechane::visit {
namespace {

TEST(OverlayText, falls_back_to_a_language_that_is_there) {
  const std::map<std::string, std::string> both{{"el", "νερό"}, {"en", "water"}};
  EXPECT_EQ(text_in(both, "el"), "νερό");
  EXPECT_EQ(text_in(both, "fr"), "water");
  EXPECT_EQ(text_in({{"el", "νερό"}}, "en"), "νερό");
  EXPECT_EQ(text_in({}, "en"), "");
}

TEST(OverlayText, shows_what_visitors_read_as_they_write_it) {
  client::WorldStatus status;
  status.quantities = {{"held", ""}, {"speed", "rpm"}, {"basin", "l"}, {"level", "m"}, {"lifted", "l"}};
  client::Frame frame;
  frame.quantities = {1, -31.4, 12.44, 0.05, 99};
  const picture::OverlayContent greek = OverlayWriter("el").write(status, &frame);
  ASSERT_EQ(greek.readouts.size(), 2U);
  EXPECT_EQ(greek.readouts[0].value, "31");
  EXPECT_EQ(greek.readouts[1].value, "12,4");
  EXPECT_EQ(greek.readouts[1].unit, "λίτρα");
  const picture::OverlayContent english = OverlayWriter("en").write(status, &frame);
  EXPECT_EQ(english.readouts[1].value, "12.4");
}

TEST(OverlayText, a_gauge_grows_and_does_not_shrink) {
  client::WorldStatus status;
  status.quantities = {{"basin", "l"}};
  client::Frame frame;
  OverlayWriter writer("en");
  for (const auto& [value, end] : {std::pair{1.0, "5"}, {5.1, "10"}, {43.0, "50"}, {2.0, "50"}}) {
    frame.quantities = {value};
    const picture::OverlayContent content = writer.write(status, &frame);
    ASSERT_EQ(content.readouts.size(), 1U);
    EXPECT_EQ(content.readouts[0].end, end);
    EXPECT_LE(content.readouts[0].fraction, 1.0);
  }
}

TEST(OverlayText, a_gauge_has_room_for_what_the_step_waits_for_and_marks_it) {
  client::WorldStatus status;
  status.quantities = {{"basin", "l"}, {"speed", "rpm"}};
  status.quantities[0].goal = {15, false};
  client::Frame frame;
  frame.quantities = {0.5, 30};
  OverlayWriter writer("en");
  const picture::OverlayContent filling = writer.write(status, &frame);
  ASSERT_EQ(filling.readouts.size(), 2U);
  EXPECT_EQ(filling.readouts[0].end, "20");
  EXPECT_EQ(filling.readouts[0].goal, 0.75);
  EXPECT_FALSE(filling.readouts[1].goal);
  status.quantities[0].goal.reset();
  status.quantities[1].goal = {-120, true};  // a wheel that turns backwards: its speed is shown without a sign
  const picture::OverlayContent stopping = writer.write(status, &frame);
  EXPECT_FALSE(stopping.readouts[0].goal);
  EXPECT_EQ(stopping.readouts[1].goal, 0.6);
  EXPECT_EQ(stopping.readouts[1].end, "200");
  status.done = true;
  EXPECT_FALSE(writer.write(status, &frame).readouts[1].goal) << "what is done waits for nothing";
}

TEST(OverlayText, a_quantity_with_a_label_is_shown_whatever_its_unit_and_alone_in_it) {
  client::WorldStatus status;
  status.quantities = {{"basin", "l"}, {"left", "l"},    {"right", "l"},
                       {"coins", ""},  {"angle", "deg"}, {"turns", "turns"}};
  status.quantities[1].label = {{"el", "Αριστερός κύλινδρος"}, {"en", "Left cylinder"}};
  status.quantities[2].label = {{"en", "Right cylinder"}};
  status.quantities[3].label = {{"en", "Coins"}};
  status.quantities[5].label = {{"en", "Crank"}};
  client::Frame frame;
  frame.quantities = {1, 2.25, 3, 7, 30, 2.5};
  const std::vector<picture::Readout> readouts = OverlayWriter("el").write(status, &frame).readouts;
  ASSERT_EQ(readouts.size(), 4U) << "neither the litres without a label, nor the degrees";
  EXPECT_EQ(readouts[0].label, "Αριστερός κύλινδρος");
  EXPECT_EQ(readouts[0].value, "2,2");
  EXPECT_EQ(readouts[0].unit, "λίτρα");
  EXPECT_TRUE(readouts[0].named);
  EXPECT_EQ(readouts[1].label, "Right cylinder") << "not yet translated";
  EXPECT_EQ(readouts[2].value, "7") << "what has no unit is counted";
  EXPECT_EQ(readouts[2].unit, "");
  EXPECT_EQ(readouts[3].value + " " + readouts[3].unit, "2,5 στροφές");
}

TEST(OverlayText, a_gauge_with_a_range_stays_as_its_author_made_it) {
  client::WorldStatus status;
  status.quantities = {{"warmth", "degC"}};
  status.quantities[0].range = {-10, 30};
  status.quantities[0].goal = {25, false};
  client::Frame frame;
  OverlayWriter writer("en");
  for (const auto& [value, fraction] : {std::pair{-10.0, 0.0}, {-30.0, 0.0}, {0.0, 0.25}, {20.0, 0.75}, {900.0, 1.0}}) {
    frame.quantities = {value};
    const picture::Readout readout = writer.write(status, &frame).readouts.at(0);
    EXPECT_EQ(readout.begin + " to " + readout.end, "-10 to 30");
    EXPECT_DOUBLE_EQ(readout.fraction, fraction) << value;
    EXPECT_DOUBLE_EQ(readout.goal.value(), 0.875);
  }
  frame.quantities = {-7};
  EXPECT_EQ(writer.write(status, &frame).readouts.at(0).value, "-7");
}

TEST(OverlayText, a_short_range_has_more_decimals) {
  client::WorldStatus status;
  status.quantities = {{"depth", "m"}, {"coins", ""}, {"basin", "l"}};
  for (client::QuantityInfo& quantity : status.quantities)
    quantity.label = {{"en", quantity.name}};
  status.quantities[0].range = {0.25, 1.5};
  status.quantities[1].range = {0, 5};
  client::Frame frame;
  frame.quantities = {0.5, 3, 12};
  const std::vector<picture::Readout> readouts = OverlayWriter("el").write(status, &frame).readouts;
  ASSERT_EQ(readouts.size(), 3U);
  EXPECT_EQ(readouts[0].value, "0,50");
  EXPECT_EQ(readouts[0].begin, "0,25");
  EXPECT_EQ(readouts[0].end, "1,5");
  EXPECT_DOUBLE_EQ(readouts[0].fraction, 0.2);
  EXPECT_EQ(readouts[1].value, "3");
  EXPECT_EQ(readouts[2].begin + " " + readouts[2].end, "0 20") << "without a range it grows as ever";
}

TEST(OverlayText, a_speed_has_a_sign_where_its_gauge_begins_below_0) {
  client::WorldStatus status;
  status.quantities = {{"speed", "rpm"}};
  status.quantities[0].range = {0, 100};
  status.quantities[0].goal = {-50, true};
  client::Frame frame;
  frame.quantities = {-25};
  const picture::Readout plain = OverlayWriter("en").write(status, &frame).readouts.at(0);
  EXPECT_EQ(plain.value, "25");
  EXPECT_DOUBLE_EQ(plain.fraction, 0.25);
  EXPECT_DOUBLE_EQ(plain.goal.value(), 0.5);
  status.quantities[0].range = {-100, 100};
  const picture::Readout both_ways = OverlayWriter("en").write(status, &frame).readouts.at(0);
  EXPECT_EQ(both_ways.value, "-25");
  EXPECT_DOUBLE_EQ(both_ways.fraction, 0.375);
  EXPECT_DOUBLE_EQ(both_ways.goal.value(), 0.25);
}

TEST(OverlayText, each_unit_that_authors_are_promised_has_a_gauge_without_a_label) {
  std::istringstream units{std::string(state::gauge_units())};
  for (std::string unit; units >> unit;) {
    client::WorldStatus status;
    status.quantities = {{"something", unit}};
    client::Frame frame;
    frame.quantities = {1};
    EXPECT_EQ(OverlayWriter("en").write(status, &frame).readouts.size(), 1U) << unit;
  }
}

TEST(OverlayText, numbers_that_are_none_are_left_out) {
  client::WorldStatus status;
  status.quantities = {{"basin", "l"}, {"speed", "rpm"}};
  client::Frame frame;
  frame.quantities = {std::numeric_limits<double>::quiet_NaN()};
  EXPECT_TRUE(OverlayWriter("en").write(status, &frame).readouts.empty());
}

TEST(OverlayText, a_lost_link_is_a_calm_word) {
  EXPECT_TRUE(link_note(client::LinkState::joined, true, "el").empty());
  for (const char* language : {"el", "en"}) {
    const std::string note = link_note(client::LinkState::lost, true, language);
    EXPECT_FALSE(note.empty());
    EXPECT_EQ(note.find("rror"), std::string::npos);
  }
}

}  // namespace
}  // namespace mechane::visit
