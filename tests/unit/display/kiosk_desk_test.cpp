#include "client-sdk/display/kiosk_desk.hpp"

#include <gtest/gtest.h>

namespace mechane::display {
namespace {

constexpr TimePoint kDeskBegan{std::chrono::seconds(1000)};

TEST(PictureMeter, tells_of_the_last_seconds_alone) {
  PictureMeter meter(kDeskBegan);
  EXPECT_EQ(meter.rate(kDeskBegan).per_s, 0);
  TimePoint now = kDeskBegan;
  for (int i = 0; i < 100; ++i) {
    now += std::chrono::milliseconds(100);
    meter.drawn(std::chrono::milliseconds(i < 50 ? 90 : 20), now);
  }
  EXPECT_NEAR(meter.rate(now).per_s, 10, 0.5);
  EXPECT_NEAR(meter.rate(now).median_ms, 20, 1e-9);
  EXPECT_EQ(meter.total(), 100U);
  EXPECT_EQ(meter.rate(now + std::chrono::seconds(6)).per_s, 0) << "it stands still";
  EXPECT_EQ(meter.rate(now + std::chrono::seconds(6)).median_ms, 0);
}

TEST(PictureMeter, one_slow_picture_in_fifty_is_seen_in_the_p99) {
  PictureMeter meter(kDeskBegan);
  for (int i = 1; i <= 50; ++i)
    meter.drawn(std::chrono::milliseconds(i == 25 ? 300 : 10), kDeskBegan + i * std::chrono::milliseconds(16));
  EXPECT_NEAR(meter.rate(kDeskBegan + std::chrono::milliseconds(800)).median_ms, 10, 1e-9);
  EXPECT_NEAR(meter.rate(kDeskBegan + std::chrono::milliseconds(800)).p99_ms, 300, 1e-9);
  EXPECT_NEAR(meter.rate(kDeskBegan + std::chrono::milliseconds(800)).per_s, 62.5, 1e-9)
      << "of a start: over what has passed";
}

TEST(TrafficMeter, tells_the_share_that_was_lost_lately) {
  TrafficMeter meter;
  client::FrameTraffic traffic;
  EXPECT_EQ(meter.rate(traffic, kDeskBegan).lost, 0);
  TimePoint now = kDeskBegan;
  for (int s = 0; s < 30; ++s) {
    now += std::chrono::seconds(1);
    traffic.received += 54;
    traffic.lost += 6;
    (void)meter.rate(traffic, now);
  }
  EXPECT_NEAR(meter.rate(traffic, now).lost, 0.1, 1e-9);
  EXPECT_NEAR(meter.rate(traffic, now).per_s, 54, 1e-9);
  for (int s = 0; s < 12; ++s) {
    now += std::chrono::seconds(1);
    traffic.received += 60;
    (void)meter.rate(traffic, now);
  }
  EXPECT_EQ(meter.rate(traffic, now).lost, 0) << "it is over";
  EXPECT_NEAR(meter.rate(traffic, now).per_s, 60, 1e-9);
}

}  // namespace
}  // namespace mechane::display
