#include "client-sdk/haptic/hand_motion.hpp"

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

TEST(HandMotion, OneJointIsEnoughAndATremorIsNot) {
  HandMotion motion;
  hand::HandAngles angles{};
  EXPECT_EQ(motion.rests_for(TimePoint{1h}), Duration{0}) << "nothing is known";
  EXPECT_FALSE(motion.note(TimePoint{1h}, angles)) << "the first angles are no motion";
  angles[7] = 0.9 * HandMotion::kLeast_rad;
  EXPECT_FALSE(motion.note(TimePoint{1h} + 1s, angles));
  EXPECT_EQ(motion.rests_for(TimePoint{1h} + 1s), 1s);
  angles[7] = -1.1 * HandMotion::kLeast_rad;
  EXPECT_TRUE(motion.note(TimePoint{1h} + 2s, angles));
  EXPECT_EQ(motion.rests_for(TimePoint{1h} + 5s), 3s);
}

TEST(HandMotion, ASlowMotionCountsToo) {
  HandMotion motion;
  int moved = 0;
  for (int i = 0; i <= 1000; ++i)
    moved += motion.note(TimePoint{1h} + i * 1ms, {0.001 * i}) ? 1 : 0;
  EXPECT_EQ(moved, 6) << "1 rad in steps of more than 0.15";
}

TEST(HandMotion, AClosedHandThatTurnsACrankIsThere) {
  HandMotion motion;
  const hand::HandAngles closed{0, 1, 1, 1};
  Pose X_WH;
  for (TimePoint now{1h}; now < TimePoint{1h} + 5min; now += 10ms) {
    const double turn = to_seconds(now.time_since_epoch());
    X_WH.p = 0.1 * Vec3(std::cos(turn), std::sin(turn), 0);
    motion.note(now, closed, X_WH);
    ASSERT_LT(motion.rests_for(now), 1s);
  }
}

TEST(HandMotion, AWristThatTwistsMovesAndOneThatTremblesDoesNot) {
  constexpr double kScale = 10;
  for (const double share : {0.9, 1.1}) {
    Pose shifted, turned;
    shifted.p.x() = share * kScale * HandMotion::kLeast_m;
    turned.R = quat_from_rotation_vector(share * HandMotion::kLeast_rad * Vec3::UnitZ());
    for (const Pose& X_WH : {shifted, turned}) {
      HandMotion motion(kScale);
      EXPECT_FALSE(motion.note(TimePoint{1h}, {}, {}));
      EXPECT_EQ(motion.note(TimePoint{1h} + 1s, {}, X_WH), share > 1);
    }
  }
}

}  // namespace
}  // namespace mechane::haptic
