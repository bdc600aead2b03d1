#include "client-sdk/client/frame_history.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace mechane::client {
namespace {

using namespace std::chrono_literals;

Frame frame_at(std::uint64_t sequence, double x, double angle) {
  Frame f;
  f.sequence = sequence;
  f.bodies.push_back({0, {Vec3(x, 0, 0), quat_from_rotation_vector(Vec3(0, 0, angle))}});
  f.visible = {1};
  f.quantities = {x};
  return f;
}

RC_GTEST_PROP(FrameHistory, BetweenTwoFramesEverythingLiesBetween, ()) {
  const double t = *rc::gen::inRange(0, 1001) / 1000.0;
  const double angle = *rc::gen::inRange(-3000, 3001) / 1000.0;
  Frame out;
  interpolate(frame_at(1, 2, 0), frame_at(2, 4, angle), t, out);
  RC_ASSERT(std::abs(out.bodies[0].X_WB.p.x() - (2 + 2 * t)) < 1e-12);
  RC_ASSERT(std::abs(out.quantities[0] - (2 + 2 * t)) < 1e-12);
  RC_ASSERT(std::abs(out.bodies[0].X_WB.R.norm() - 1) < 1e-12);
  RC_ASSERT(std::abs(rotation_vector(out.bodies[0].X_WB.R).z() - t * angle) < 1e-9);
}

TEST(FrameHistory, JitterOfReceiptDoesNotShakeTheSceneAndExtrapolationEnds) {
  FrameHistory history;
  const TimePoint begin = TimePoint{} + 1h;
  for (int i = 0; i < 30; ++i) {
    Frame f = frame_at(static_cast<std::uint64_t>(i + 1), 0.016 * i, 0);  // 1 m/s
    f.received = begin + i * 16ms + (i % 3) * 4ms;
    history.add(f, static_cast<std::uint64_t>((i * 16ms + 0ns) / 1ns));
  }
  Frame out;
  for (int ms = 60; ms < 440; ++ms) {
    ASSERT_TRUE(history.at(begin + ms * 1ms, out));
    EXPECT_NEAR(out.bodies[0].X_WB.p.x(), ms * 1e-3, 1e-3) << ms;
  }
  ASSERT_TRUE(history.at(begin + 10s, out));
  EXPECT_NEAR(out.bodies[0].X_WB.p.x(), 29 * 0.016 + 0.05, 5e-3);
}

TEST(FrameHistory, IsEmptyAtFirstAndDropsWhatComesLate) {
  FrameHistory history;
  Frame out;
  EXPECT_FALSE(history.at(TimePoint{} + 1h, out));
  for (const std::uint64_t sequence : {5u, 4u}) {
    Frame f = frame_at(sequence, static_cast<double>(sequence), 0);
    f.received = TimePoint{} + 1h;
    history.add(f, sequence);
  }
  ASSERT_TRUE(history.at(TimePoint{} + 1h, out));
  EXPECT_EQ(out.sequence, 5u);
}

}  // namespace
}  // namespace mechane::client
