// The driver that plays a recorded hand, and what it reads.
#include <chrono>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "client-sdk/drivers/playback/recording.hpp"
#include "tests/support/driver_under_test.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::drivers {
namespace {

constexpr const char* kTwoSeconds =
    "# a hand\n"
    "0 0 0 0 1 0 0 0 0 0\n"
    "\n"
    "1 0.1 0 0 1 0 0 0 0.5 1\r\n"
    "2 0.1 0.2 0 0 0 1 0 1 0\n";

std::string fault_of_recording(const std::string& text) {
  HandRecording recording;
  return recording.take_text(text);
}

TEST(PlaybackRecording, StandsBetweenItsMoments) {
  HandRecording recording;
  ASSERT_EQ(recording.take_text(kTwoSeconds), "");
  EXPECT_EQ(recording.length_s(), 2);
  EXPECT_FALSE(recording.is_glove);
  EXPECT_DOUBLE_EQ(recording.at(0.5).position_m[0], 0.05);
  EXPECT_DOUBLE_EQ(recording.at(0.5).grasp, 0.25);
  EXPECT_EQ(recording.at(1.5).buttons, 1u) << "a button is pressed until the moment that says otherwise";
  EXPECT_NEAR(recording.at(1.5).orientation_wxyz[0], std::sqrt(0.5), 1e-12) << "half of half a turn";
  EXPECT_EQ(recording.at(-1).position_m[0], 0) << "it stands still before";
  EXPECT_EQ(recording.at(9).position_m[1], 0.2) << "and after";
}

TEST(PlaybackRecording, SaysWhichHandItIsOfBeforeItsFirstMoment) {
  HandRecording right, left;
  ASSERT_EQ(right.take_text(kTwoSeconds), "");
  EXPECT_FALSE(right.is_left);
  ASSERT_EQ(left.take_text(std::string("left\n") + kTwoSeconds), "");
  EXPECT_TRUE(left.is_left);
  EXPECT_NE(fault_of_recording(std::string(kTwoSeconds) + "left\n"), "");
}

TEST(PlaybackRecording, TurnsTheShorterWay) {
  HandRecording recording;
  ASSERT_EQ(recording.take_text("0 0 0 0 1 0 0 0 0 0\n1 0 0 0 -0.8 -0.6 0 0 0 0\n"), "");
  EXPECT_GT(recording.at(0.5).orientation_wxyz[0], 0.9);
}

TEST(PlaybackRecording, IsRefusedWhereItIsWrong) {
  const std::string good = "0 0 0 0 1 0 0 0 0 0\n";
  ASSERT_EQ(fault_of_recording(good), "");
  for (const char* line : {"0 0 0 0 1 0 0 0 0 0", "1 0 0 0 1 0 0 0 0", "1 0 0 0 1 0 0 0 0 0 0", "1 x 0 0 1 0 0 0 0 0",
                           "1 nan 0 0 1 0 0 0 0 0", "1 inf 0 0 1 0 0 0 0 0", "1 101 0 0 1 0 0 0 0 0",
                           "1 0 0 0 1 1 0 0 0 0", "1 0 0 0 1 0 0 0 1.1 0", "1 0 0 0 1 0 0 0 0 0.5",
                           "1 0 0 0 1 0 0 0 0 -1", "1 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0"})
    EXPECT_NE(fault_of_recording(good + line).find("line 2"), std::string::npos) << line;
  for (const char* text : {"", "# nothing\n", "\n\n"})
    EXPECT_NE(fault_of_recording(text), "");
}

TEST(PlaybackDriver, PlaysAtASpeedFromAPlace) {
  const test::ScratchFolder folder;
  const std::string file = "file=" + folder.write("hand", kTwoSeconds).string();
  test::DriverUnderTest driver("playback");
  ASSERT_EQ(driver.open(file + ",speed=100,from=0.25"), "");
  mechane_device_info info;
  ASSERT_EQ(driver.describe(info), "");
  EXPECT_EQ(info.output, MECHANE_OUTPUT_NONE);
  mechane_device_state state;
  ASSERT_EQ(driver.read(state), "");
  EXPECT_GE(state.position_m[0], 0.025);
  EXPECT_EQ(state.flags, MECHANE_STATE_READY);
  for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
       state.position_m[1] < 0.2 && std::chrono::steady_clock::now() < end;)
    ASSERT_EQ(driver.read(state), "");
  EXPECT_EQ(state.position_m[1], 0.2);
}

TEST(PlaybackDriver, SaysWhatIsWrong) {
  const test::ScratchFolder folder;
  const std::string file = "file=" + folder.write("hand", kTwoSeconds).string();
  for (const std::string& options : {std::string(), std::string("file=/nowhere/hand"), file + ",from=3",
                                     file + ",speed=0", "file=" + folder.write("text", "text").string()})
    EXPECT_NE(test::DriverUnderTest("playback").open(options), "") << options;
}

}  // namespace
}  // namespace mechane::drivers
