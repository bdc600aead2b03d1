#include "client-sdk/recording/recorded_client.hpp"

#include <gtest/gtest.h>

#include "client-sdk/recording/recording_codec.hpp"
#include "tests/unit/recording/recording_samples.hpp"

namespace mechane::recording {
namespace {

using std::chrono::milliseconds;

constexpr TimePoint kPlayedFrom = TimePoint(std::chrono::hours(7));

double bucket_height(RecordedClient& client, TimePoint now) {
  client.advance(now);
  client::Frame frame;
  EXPECT_TRUE(client.interpolated_frame(now, milliseconds(33), frame));
  return frame.bodies.at(1).X_WB.p.y();
}

TEST(RecordedClient, shows_what_was_at_each_moment_between_frames_too) {
  RecordedClient client(played({0, 40, 80, 120, 160, 200}), {});
  for (const int ms : {0, 10, 40, 55, 133, 200})
    EXPECT_NEAR(bucket_height(client, kPlayedFrom + milliseconds(ms)), 0.5e-3 * ms, 1e-6) << ms;
  EXPECT_EQ(client.state(), client::LinkState::joined);
  EXPECT_EQ(client.world_status()->step, "turn");
  EXPECT_EQ(client.objects().size(), 2U);
  EXPECT_EQ(client.presentation()->languages.size(), 2U);
  EXPECT_EQ(client.take_events().size(), 1U);
  EXPECT_TRUE(client.take_events().empty());
}

TEST(RecordedClient, the_worlds_time_goes_with_the_poses) {
  PlaySettings settings;
  settings.speed = 0.1;
  RecordedClient client(played({0, 40, 80}), settings);
  client.advance(kPlayedFrom);
  for (const int ms : {0, 7, 39, 40, 61}) {
    const TimePoint now = kPlayedFrom + milliseconds(10 * ms);
    client.advance(now);
    client::Frame frame;
    ASSERT_TRUE(client.interpolated_frame(now, Duration{0}, frame));
    EXPECT_NEAR(static_cast<double>(frame.tick), ms, 1) << ms;
  }
}

TEST(RecordedClient, stands_still_when_it_is_over_or_begins_anew) {
  RecordedClient once(played({0, 40, 80}), {});
  EXPECT_NEAR(bucket_height(once, kPlayedFrom), 0, 1e-6);
  EXPECT_FALSE(once.over());
  EXPECT_NEAR(bucket_height(once, kPlayedFrom + milliseconds(900)), 0.04, 1e-6);
  EXPECT_TRUE(once.over());
  PlaySettings settings;
  settings.again = true;
  RecordedClient again(played({0, 40, 80}), settings);
  (void)bucket_height(again, kPlayedFrom);
  EXPECT_NEAR(bucket_height(again, kPlayedFrom + milliseconds(80)), 0.04, 1e-6);
  EXPECT_NEAR(bucket_height(again, kPlayedFrom + milliseconds(90)), 0, 1e-6);
  EXPECT_NEAR(bucket_height(again, kPlayedFrom + milliseconds(130)), 0.02, 1e-6);
  EXPECT_FALSE(again.over());
  again.rewind();
  EXPECT_NEAR(bucket_height(again, kPlayedFrom + milliseconds(150)), 0, 1e-6);
}

TEST(RecordedClient, plays_faster_slower_and_from_the_middle) {
  for (const double speed : {0.25, 1.0, 4.0}) {
    PlaySettings settings;
    settings.speed = speed;
    settings.from = milliseconds(40);
    RecordedClient client(played({0, 40, 80, 120, 160, 200}), settings);
    EXPECT_NEAR(bucket_height(client, kPlayedFrom), 0.02, 1e-6);
    const auto later = std::chrono::duration_cast<Duration>(milliseconds(100) / speed);
    EXPECT_NEAR(bucket_height(client, kPlayedFrom + later), 0.07, 1e-6);
  }
}

TEST(RecordedClient, where_nothing_was_heard_nothing_moves) {
  RecordedClient client(played({0, 40, 3000, 3040}), {});
  (void)bucket_height(client, kPlayedFrom);
  EXPECT_NEAR(bucket_height(client, kPlayedFrom + milliseconds(1500)), 0.02, 1e-6);
  EXPECT_NEAR(bucket_height(client, kPlayedFrom + milliseconds(3020)), 1.51, 1e-6);
}

TEST(RecordedClient, worlds_are_never_mixed) {
  RecordedClient client(played({0, 40, 80, 120}, 80), {});
  for (int ms = 0; ms <= 120; ++ms) {
    const double height = bucket_height(client, kPlayedFrom + milliseconds(ms));
    const bool second = ms >= 80;
    EXPECT_EQ(client.world_status()->world, second ? "world-2" : "world-1") << ms;
    EXPECT_EQ(client.presentation()->world, second ? "world-2" : "world-1") << ms;
    EXPECT_TRUE(second ? height >= 0.04 - 1e-6 : height <= 0.02 + 1e-6) << ms;
  }
}

TEST(RecordedClient, nobody_is_there_to_be_told_anything) {
  RecordedClient client(played({0, 40}), {});
  client.advance(kPlayedFrom);
  EXPECT_FALSE(client.send({}));
  EXPECT_EQ(client.open_exhibit(""), 0U);
  EXPECT_EQ(client.click("SIGN"), 0U);
  EXPECT_FALSE(client.newest_force());
  EXPECT_FALSE(client.wait_force(std::chrono::seconds(1)));
}

}  // namespace
}  // namespace mechane::recording
