#include "client-sdk/visit/overlay_text.hpp"

#include <limits>

#include <gtest/gtest.h>

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
