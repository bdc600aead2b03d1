#include "client-sdk/haptic/calibration_course.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

/// A pinch as a glove of half the gain tells it: index finger half bent, thumb towards it.
HandAngles raw_pose(std::size_t pose) {
  HandAngles raw{};
  if (pose == 0) return raw;
  const HandAngles fist = model_fist();
  for (std::size_t j = 0; j < raw.size(); ++j)
    raw[j] = 0.5 * fist[j] * (pose == 1 ? 1.0 : 0.5);
  return raw;
}

/// The visitor does what is asked; `shown` may spoil what is seen of it.
Duration run(CalibrationCourse& course, std::vector<std::string>& told,
             const std::function<HandAngles(std::size_t pose, TimePoint now)>& shown) {
  const TimePoint start{1h};
  TimePoint now = start;
  std::size_t pose = 0;
  for (; !course.result() && now < start + 5min; now += 10ms) {
    const HandAngles raw = shown(pose, now);
    if (auto message = course.add(now, &raw)) {
      told.push_back(*message);
      for (std::size_t p = 0; p < kCalibrationPoses; ++p) {
        if (message->find(std::to_string(p + 1) + " of 3") != std::string::npos) pose = p;
      }
    }
  }
  return now - start;
}

TEST(CalibrationCourse, AsksForEachPoseOnceAndTakesUnder30Seconds) {
  CalibrationCourse course;
  std::vector<std::string> told;
  const Duration took = run(course, told, [](std::size_t pose, TimePoint) { return raw_pose(pose); });
  ASSERT_TRUE(course.result() && course.result()->has_value())
      << (course.result() ? course.result()->error().to_string() : "not finished");
  EXPECT_LT(took, 30s);
  EXPECT_EQ(told.size(), kCalibrationPoses + 1);
  const HandAngles fist = (*course.result())->apply(raw_pose(1));
  EXPECT_NEAR(fist[5], model_fist()[5], 0.02) << "the glove tells half of it";
}

TEST(CalibrationCourse, AsksAgainForAHandThatMoved) {
  CalibrationCourse course;
  std::vector<std::string> told;
  run(course, told, [](std::size_t pose, TimePoint now) {
    HandAngles raw = raw_pose(pose);
    if (pose == 1 && now < TimePoint{1h} + 9s) raw[9] += 0.5 * std::sin(20 * to_seconds(now.time_since_epoch()));
    return raw;
  });
  ASSERT_TRUE(course.result() && course.result()->has_value());
  EXPECT_EQ(told.size(), kCalibrationPoses + 2);
}

TEST(CalibrationCourse, BeginsAgainWhereTheFirstTwoPosesWereSwapped) {
  CalibrationCourse course;
  std::vector<std::string> told;
  run(course, told, [](std::size_t pose, TimePoint now) {
    const bool swapped = pose < 2 && now < TimePoint{1h} + 10s;
    return raw_pose(swapped ? 1 - pose : pose);
  });
  ASSERT_TRUE(course.result() && course.result()->has_value());
  EXPECT_EQ(told.size(), kCalibrationPoses + 3) << "flat, fist, both again, pinch, done";
}

TEST(CalibrationCourse, FailsWhereAPoseIsNeverShown) {
  CalibrationCourse course;
  std::vector<std::string> told;
  run(course, told, [](std::size_t pose, TimePoint) { return raw_pose(pose == 1 ? 0 : pose); });
  ASSERT_TRUE(course.result().has_value());
  EXPECT_FALSE(course.result()->has_value());
  EXPECT_EQ(told.size(), 1u + CalibrationCourse::kTries);
}

TEST(CalibrationCourse, FailsWithAGloveThatIsNeverReady) {
  CalibrationCourse course;
  for (TimePoint now{1h}; !course.result() && now < TimePoint{1h} + 5min; now += 10ms)
    (void)course.add(now, nullptr);
  ASSERT_TRUE(course.result().has_value());
  EXPECT_FALSE(course.result()->has_value());
}

}  // namespace
}  // namespace mechane::haptic
