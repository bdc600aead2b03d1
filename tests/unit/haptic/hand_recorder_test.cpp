#include "client-sdk/haptic/hand_recorder.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "client-sdk/drivers/playback/recording.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/scratch_folder.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

client::HandSample hand_at(double x, client::HandKind kind) {
  client::HandSample hand;
  if (kind == client::HandKind::glove) hand.side = client::HandSide::left;
  hand.kind = kind;
  hand.X_WH.p = Vec3(x, 0.5, -0.25);
  hand.X_WH.R = Quat(0.5, 0.5, -0.5, 0.5);
  hand.grasp_intent = 0.75;
  hand.buttons = 3;
  hand.joints.fill(0.125);
  return hand;
}

TEST(HandRecorder, WritesWhatPlaybackReads) {
  for (const auto kind : {client::HandKind::one_point, client::HandKind::glove}) {
    const test::ScratchFolder folder;
    const auto file = folder.path() / "hand";
    auto recorder = HandRecorder::open(file.string());
    ASSERT_TRUE(recorder) << recorder.error().to_string();
    const TimePoint start{7h};
    for (int i = 0; i < 100; ++i) {
      const test::AllocationGuard guard;
      (*recorder)->note(hand_at(0.001 * i, kind), start + i * kTickPeriod);
      EXPECT_EQ(guard.allocations(), 0u);
    }
    ASSERT_TRUE((*recorder)->write());
    EXPECT_EQ((*recorder)->lost(), 0u);
    drivers::HandRecording recording;
    ASSERT_EQ(recording.take_text(text_of(file)), "");
    EXPECT_EQ(recording.hands.size(), 100u);
    EXPECT_EQ(recording.is_glove, kind == client::HandKind::glove);
    EXPECT_EQ(recording.is_left, recording.is_glove);
    EXPECT_NEAR(recording.length_s(), 0.099, 1e-9);
    const mechane_device_state state = recording.at(0.0505);
    EXPECT_NEAR(state.position_m[0], 0.0505, 1e-9);
    EXPECT_NEAR(state.orientation_wxyz[2], -0.5, 1e-6);
    EXPECT_EQ(state.grasp, 0.75);
    EXPECT_EQ(state.buttons, 3u);
    EXPECT_EQ(state.joints_rad[19], recording.is_glove ? 0.125 : 0);
  }
}

TEST(HandRecorder, CountsWhatThereIsNoRoomFor) {
  const test::ScratchFolder folder;
  auto recorder = HandRecorder::open((folder.path() / "hand").string());
  ASSERT_TRUE(recorder);
  for (int i = 0; i < 5000; ++i)
    (*recorder)->note({}, TimePoint(i * kTickPeriod));
  EXPECT_EQ((*recorder)->lost(), 5000u - 4096u);
}

TEST(HandRecorder, AFullDiskIsAnError) {
  EXPECT_FALSE(HandRecorder::open("/dev/full"));
}

}  // namespace
}  // namespace mechane::haptic
