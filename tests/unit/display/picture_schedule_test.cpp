#include "client-sdk/display/picture_schedule.hpp"

#include <gtest/gtest.h>

namespace mechane::display {
namespace {

using std::chrono::milliseconds;

client::WorldStatus at(const std::string& activity, const std::string& step, bool done = false) {
  client::WorldStatus status;
  status.activity = activity;
  status.step = step;
  status.done = done;
  return status;
}

TEST(PictureSchedule, one_picture_a_step_after_it_settled) {
  PictureSchedule schedule;
  const TimePoint start{};
  EXPECT_FALSE(schedule.due(start, at("use", "grasp")));
  EXPECT_FALSE(schedule.due(start + milliseconds(499), at("use", "grasp")));
  EXPECT_EQ(schedule.due(start + milliseconds(501), at("use", "grasp")), "use-grasp");
  EXPECT_FALSE(schedule.due(start + milliseconds(900), at("use", "grasp")));
  EXPECT_FALSE(schedule.due(start + milliseconds(1000), at("use", "turn", true)));
  EXPECT_EQ(schedule.due(start + milliseconds(1200), at("use", "turn", true)), "use-done");
  EXPECT_TRUE(schedule.missed().empty());
}

TEST(PictureSchedule, steps_of_one_name_in_two_exhibits_are_two) {
  PictureSchedule schedule;
  const TimePoint start{};
  client::WorldStatus crane = at("use", "grasp");
  crane.scenario = "crane";
  client::WorldStatus screw = crane;
  screw.scenario = "screw";
  EXPECT_FALSE(schedule.due(start, crane));
  EXPECT_EQ(schedule.due(start + milliseconds(600), crane), "use-grasp");
  EXPECT_FALSE(schedule.due(start + milliseconds(700), screw));
  EXPECT_EQ(schedule.due(start + milliseconds(1300), screw), "screw-use-grasp");
  EXPECT_FALSE(schedule.due(start + milliseconds(2000), crane)) << "it has been taken";
}

TEST(PictureSchedule, a_step_too_short_is_told_as_missed_until_it_comes_again) {
  PictureSchedule schedule;
  const TimePoint start{};
  EXPECT_FALSE(schedule.due(start, at("use", "blink")));
  EXPECT_FALSE(schedule.due(start + milliseconds(100), at("use", "turn")));
  EXPECT_TRUE(schedule.missed().contains("use-blink"));
  EXPECT_FALSE(schedule.due(start + milliseconds(200), at("use", "blink")));
  EXPECT_EQ(schedule.due(start + milliseconds(800), at("use", "blink")), "use-blink");
  EXPECT_FALSE(schedule.missed().contains("use-blink"));
}

TEST(PictureSchedule, a_picture_waits_for_a_model_that_is_on_its_way_but_not_for_ever) {
  PictureSchedule schedule;
  const TimePoint start{};
  constexpr bool kWhole = true;
  EXPECT_FALSE(schedule.due(start, at("use", "grasp"), !kWhole));
  EXPECT_FALSE(schedule.due(start + milliseconds(3000), at("use", "grasp"), !kWhole));
  EXPECT_EQ(schedule.due(start + milliseconds(3001), at("use", "grasp"), kWhole), "use-grasp");
  EXPECT_FALSE(schedule.due(start + milliseconds(4000), at("use", "turn"), !kWhole));
  EXPECT_FALSE(schedule.due(start + milliseconds(4000) + PictureSchedule::kPatience - milliseconds(1),
                            at("use", "turn"), !kWhole));
  EXPECT_EQ(schedule.due(start + milliseconds(4000) + PictureSchedule::kPatience, at("use", "turn"), !kWhole),
            "use-turn");
  EXPECT_TRUE(schedule.missed().empty());
}

TEST(PictureSchedule, names_cannot_leave_the_folder) {
  EXPECT_EQ(file_name("../../etc/passwd"), "------etc-passwd");
  EXPECT_EQ(file_name("use_1-b"), "use_1-b");
  EXPECT_LE(file_name(std::string(5000, 'x')).size(), 100U);
}

}  // namespace
}  // namespace mechane::display
