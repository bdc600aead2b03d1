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
  const HandAngles fist = model_pose(CalibrationPose::fist);
  for (std::size_t j = 0; j < raw.size(); ++j)
    raw[j] = 0.5 * fist[j] * (pose == 1 ? 1.0 : 0.5);
  return raw;
}

/// The visitor puts the glove on, and then does what is asked; `shown` may spoil what is seen of it.
Duration run(CalibrationCourse& course, std::vector<std::string>& told,
             const std::function<HandAngles(std::size_t pose, TimePoint now)>& shown) {
  const TimePoint start{1h};
  TimePoint now = start;
  std::size_t pose = 0;
  for (; !course.result() && now < start + 5min; now += 10ms) {
    const bool asked = course.news().step != client::CalibrationStep::none;
    const HandAngles raw = asked ? shown(pose, now) : raw_pose(told.size() % 2);
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
  EXPECT_EQ(told.size(), kCalibrationPoses + 2) << "the glove, three poses, done";
  const HandAngles fist = (*course.result())->apply(raw_pose(1));
  EXPECT_NEAR(fist[5], model_pose(CalibrationPose::fist)[5], 0.02) << "the glove tells half of it";
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
  EXPECT_EQ(told.size(), kCalibrationPoses + 3);
}

TEST(CalibrationCourse, BeginsAgainWhereTheFirstTwoPosesWereSwapped) {
  CalibrationCourse course;
  std::vector<std::string> told;
  run(course, told, [](std::size_t pose, TimePoint now) {
    const bool swapped = pose < 2 && now < TimePoint{1h} + 10s;
    return raw_pose(swapped ? 1 - pose : pose);
  });
  ASSERT_TRUE(course.result() && course.result()->has_value());
  EXPECT_EQ(told.size(), kCalibrationPoses + 4) << "the glove, flat, fist, both again, pinch, done";
}

TEST(CalibrationCourse, FailsWhereAPoseIsNeverShown) {
  CalibrationCourse course;
  std::vector<std::string> told;
  run(course, told, [](std::size_t pose, TimePoint) { return raw_pose(pose == 1 ? 0 : pose); });
  ASSERT_TRUE(course.result().has_value());
  EXPECT_FALSE(course.result()->has_value());
  EXPECT_EQ(told.size(), 2u + CalibrationCourse::kTries);
  EXPECT_EQ(course.news(), client::CalibrationNews{}) << "nothing more is asked";
}

TEST(CalibrationCourse, WaitsForAHandInTheGlove) {
  CalibrationCourse course;
  const HandAngles lies = raw_pose(2);
  for (TimePoint now{1h}; now < TimePoint{1h} + 5min; now += 10ms) {
    HandAngles raw = lies;
    for (double& angle : raw)
      angle += 0.06 * std::sin(to_seconds(now.time_since_epoch()));
    (void)course.add(now, &raw);
    ASSERT_EQ(course.news(), client::CalibrationNews{});
  }
  EXPECT_FALSE(course.result().has_value());
}

TEST(CalibrationCourse, VisitorsAreToldWhatIsTheMatterWithTheGlove) {
  using client::DeviceState;
  CalibrationCourse course;
  for (const bool asks : {false, true}) {
    EXPECT_EQ(course.news().step != client::CalibrationStep::none, asks);
    EXPECT_EQ(course.device_state(DeviceCondition::ready), asks ? DeviceState::preparing : DeviceState::let_go);
    EXPECT_EQ(course.device_state(DeviceCondition::lost), DeviceState::lost);
    EXPECT_EQ(course.device_state(DeviceCondition::hot), DeviceState::hot);
    EXPECT_EQ(course.device_state(DeviceCondition::uncalibrated), DeviceState::uncalibrated);
    EXPECT_EQ(course.device_state(DeviceCondition::not_ready), DeviceState::not_ready);
    for (const std::size_t pose : {0, 1}) {
      const HandAngles raw = raw_pose(pose);
      (void)course.add(TimePoint{1h}, &raw);
    }
  }
}

TEST(CalibrationCourse, FailsWithAGloveThatIsTakenOff) {
  CalibrationCourse course;
  client::CalibrationNews last;
  for (TimePoint now{1h}; !course.result() && now < TimePoint{1h} + 5min; now += 10ms) {
    const HandAngles raw = raw_pose(now > TimePoint{1h} ? 1 : 0);
    (void)course.add(now, course.news().step == client::CalibrationStep::none ? &raw : nullptr);
    if (!course.result()) last = course.news();
  }
  ASSERT_TRUE(course.result().has_value());
  EXPECT_FALSE(course.result()->has_value());
  EXPECT_EQ(last.refusal, client::PoseRefusal::unseen);
}

TEST(CalibrationCourse, DisplaysAreToldEachPoseAndEachTenthOfItsTime) {
  using client::CalibrationStep;
  CalibrationCourse course;
  std::vector<std::string> told;
  std::vector<client::CalibrationNews> news{{}};
  std::vector<TimePoint> at{{}};
  const auto hear = [&](TimePoint now) {
    if (course.news() == news.back()) return;
    news.push_back(course.news());
    at.push_back(now);
  };
  run(course, told, [&](std::size_t pose, TimePoint now) {
    hear(now);
    return raw_pose(pose == 1 && now < TimePoint{1h} + 12s ? 0 : pose);
  });
  hear(TimePoint{1h} + 1min);
  std::vector<std::pair<CalibrationStep, client::PoseRefusal>> asked;
  for (std::size_t i = 0; i < news.size(); ++i) {
    if (news[i].held == 0) asked.emplace_back(news[i].step, news[i].refusal);
    if (news[i].held == 0) continue;
    EXPECT_NEAR(news[i].held - news[i - 1].held, 0.1, 1e-6) << i;
    if (news[i].held < 1) {
      EXPECT_NEAR(to_seconds(at[i + 1] - at[i]), 0.3, 0.011) << i;
    }
  }
  using client::PoseRefusal;
  const decltype(asked) wanted{
      {CalibrationStep::none, PoseRefusal::none},  {CalibrationStep::flat, PoseRefusal::none},
      {CalibrationStep::fist, PoseRefusal::none},  {CalibrationStep::fist, PoseRefusal::unlike},
      {CalibrationStep::pinch, PoseRefusal::none}, {CalibrationStep::done, PoseRefusal::none}};
  EXPECT_EQ(asked, wanted);
  EXPECT_EQ(news.size(), wanted.size() + 4 * 10) << "the tenths of four poses, one of them in vain";
}

}  // namespace
}  // namespace mechane::haptic
