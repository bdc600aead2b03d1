#include "client-sdk/visit/calibration_guide.hpp"

#include <set>

#include <gtest/gtest.h>

namespace mechane::visit {
namespace {

using namespace std::chrono_literals;
using client::CalibrationNews;
using client::CalibrationStep;
using client::DeviceReport;
using client::PoseRefusal;

constexpr TimePoint kStart{3h};

class CalibrationGuideTest : public testing::Test {
 protected:
  void hear(Duration at, CalibrationNews news) { guide_.hear({{.calibration = news}}, kStart + at); }
  [[nodiscard]] std::optional<picture::OverlayPose> at(Duration when, const std::string& language = "en") const {
    return guide_.at(kStart + when, language);
  }
  CalibrationGuide guide_;
};

TEST_F(CalibrationGuideTest, EachPoseHasItsOwnPictureAndWordsInBothLanguages) {
  std::set<std::string> texts;
  std::set<float> drawings;
  for (const auto step : {CalibrationStep::flat, CalibrationStep::fist, CalibrationStep::pinch}) {
    hear(0s, {step});
    ASSERT_TRUE(at(0s) && guide_.asks());
    texts.insert({at(0s)->text, at(0s)->more, at(0s, "el")->text, at(0s, "el")->more});
    drawings.insert(at(0s)->drawing.back().to.x());
    EXPECT_EQ(at(0s)->done + 1, static_cast<std::uint32_t>(step));
    EXPECT_EQ(at(0s, "fr")->text, at(0s)->text);
    EXPECT_EQ(at(0s)->again, "");
  }
  EXPECT_EQ(texts.size(), 12U);
  EXPECT_EQ(drawings.size(), 3U);
}

TEST_F(CalibrationGuideTest, ThePictureIsOfTheHandThatIsInTheGlove) {
  const CalibrationNews news{CalibrationStep::flat};
  hear(0s, news);
  const float thumb = at(0s)->drawing.back().to.x();
  guide_.hear({{.side = client::HandSide::left, .calibration = news}}, kStart);
  EXPECT_EQ(at(0s)->drawing.back().to.x(), -thumb);
}

TEST_F(CalibrationGuideTest, TheRingFillsSteadilyBetweenTheMessages) {
  hear(0s, {CalibrationStep::flat});
  float before = 0;
  for (int tenth = 1; tenth <= 10; ++tenth) {
    hear(tenth * 300ms, {CalibrationStep::flat, 0.1F * static_cast<float>(tenth)});
    for (Duration late = 0ms; late < 300ms; late += 20ms) {
      const float held = at(tenth * 300ms + late)->held;
      EXPECT_GE(held, before);
      EXPECT_LT(held - before, 0.011F);
      before = held;
    }
  }
  EXPECT_NEAR(at(3300ms)->held, 1, 1e-6);
  EXPECT_EQ(at(9s)->held, at(3300ms)->held) << "no more is told";
  hear(9s, {CalibrationStep::fist});
  EXPECT_EQ(at(9s)->held, 0) << "the next pose";
}

TEST_F(CalibrationGuideTest, EachRefusalIsSaidAndEmptiesTheRing) {
  std::set<std::string> reasons;
  for (const auto refusal : {PoseRefusal::moved, PoseRefusal::unlike, PoseRefusal::swapped, PoseRefusal::unseen}) {
    hear(0s, {CalibrationStep::fist, 1});
    hear(1s, {CalibrationStep::fist, 0, refusal});
    EXPECT_EQ(at(1s)->held, 0);
    reasons.insert({at(1s)->again, at(1s, "el")->again});
  }
  EXPECT_EQ(reasons.size(), 8U);
}

TEST_F(CalibrationGuideTest, ThanksAreShortAndOnlyForWhoWasAsked) {
  hear(0s, {CalibrationStep::done});
  EXPECT_FALSE(at(0s)) << "a display that came later";
  hear(1s, {CalibrationStep::pinch, 1});
  for (Duration now = 2s; now < 20s; now += 100ms) {
    hear(now, {CalibrationStep::done});
    const auto shown = at(now);
    ASSERT_EQ(shown.has_value(), now <= 2s + CalibrationGuide::kThanks);
    if (!shown) continue;
    EXPECT_EQ(shown->text, "Thank you!");
    EXPECT_TRUE(shown->drawing.empty() && shown->done == shown->total);
  }
}

TEST_F(CalibrationGuideTest, AProgramThatEndedIsNotThanked) {
  hear(0s, {CalibrationStep::pinch});
  guide_.hear({}, kStart + 1s);
  EXPECT_FALSE(at(1s));
  hear(2s, {CalibrationStep::pinch});
  hear(3s, {});
  EXPECT_FALSE(at(3s)) << "it was given up";
}

TEST_F(CalibrationGuideTest, AnotherHandThatIsDoneDoesNotDisturb) {
  const DeviceReport done{.user = 1, .calibration = {CalibrationStep::done}};
  guide_.hear({{.calibration = {CalibrationStep::fist}}, done}, kStart);
  EXPECT_EQ(at(0s)->text, "Make a fist");
  guide_.hear({{}, done}, kStart + 1s);
  EXPECT_FALSE(at(1s)) << "it is not the one that was asked";
}

TEST_F(CalibrationGuideTest, BesideAnotherGloveItSaysWhichOneIsMeant) {
  using client::DeviceState;
  using client::HandKind;
  const DeviceReport other{.user = 0, .state = DeviceState::ready, .kind = HandKind::glove};
  DeviceReport asked{.user = 1, .state = DeviceState::preparing, .kind = HandKind::glove};
  asked.calibration.step = CalibrationStep::fist;
  guide_.hear({other, asked}, kStart);
  EXPECT_EQ(at(0s)->text, "Glove 2: Make a fist");
  EXPECT_EQ(at(0s, "el")->text, "Το γάντι 2: Κλείστε το χέρι σε γροθιά");
  asked.calibration.step = CalibrationStep::done;
  guide_.hear({other, asked}, kStart + 1s);
  EXPECT_EQ(at(1s)->more, "Glove 2 fits your hand now.");
  asked.calibration.step = CalibrationStep::fist;
  for (const DeviceReport& no_glove :
       {DeviceReport{.state = DeviceState::ready}, DeviceReport{.kind = HandKind::glove}}) {
    guide_.hear({no_glove, asked}, kStart + 2s);
    EXPECT_EQ(at(2s)->text, "Make a fist") << "a handle, or a program without a device";
  }
}

}  // namespace
}  // namespace mechane::visit
