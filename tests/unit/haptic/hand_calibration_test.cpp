// Three poses of a glove that is wrong in a way of its own, and what is refused.
#include "client-sdk/haptic/hand_calibration.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "server/hand/hand_skeleton.hpp"
#include "tests/support/property_draw.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;

constexpr double kCalibrationDegree = kPi / 180;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kTouching_m = 0.0095 + 0.0075;  // the radii of both tips

/// Gives (truth - offset) / gain.
struct WrongGlove {
  HandAngles gain{};
  HandAngles offset{};
  [[nodiscard]] HandAngles reads(const HandAngles& truth) const {
    HandAngles raw;
    for (std::size_t j = 0; j < raw.size(); ++j)
      raw[j] = (truth[j] - offset[j]) / gain[j];
    return raw;
  }
};

WrongGlove right_glove() {
  WrongGlove glove;
  glove.gain.fill(1);
  return glove;
}

WrongGlove any_glove() {
  WrongGlove glove = right_glove();
  for (std::size_t j = 0; j < glove.gain.size(); ++j) {
    glove.offset[j] = *test::between(-0.5, 0.5);
    const bool sideways = j >= hand::kFingerJoints && j % hand::kFingerJoints == 0;  // no pose tells its gain
    if (!sideways) glove.gain[j] = *test::between(0.6, 1.6);
  }
  return glove;
}

/// Between the middles of the round ends of thumb and index finger.
double tips_apart_m(const HandAngles& angles) {
  const hand::FingerSizes sizes = hand::middle_sized_fingers();
  std::array<Vec3, 2> tips;
  for (std::size_t f = 0; f < 2; ++f) {
    std::array<Pose, hand::kPhalanges> X_HS;
    hand::place_finger(sizes, f, {}, std::span<const double, 4>(&angles[4 * f], 4), Pose{}, X_HS);
    tips[f] = X_HS[2] * Vec3(sizes[f].length_m[2] / 2 - sizes[f].radius_m[2] / 2, 0, 0);
  }
  return (tips[0] - tips[1]).norm();
}

/// Tips that touch: the index finger is bent until they do. Its other fingers are as far bent as the middle finger of a loose hand.
std::optional<HandAngles> pinch_like(HandAngles angles) {
  double open = 0.5, closed = 1.1;
  const HandAngles drawn = angles;
  const auto gap = [&](double share) {
    for (std::size_t j = 5; j < 8; ++j)
      angles[j] = share * drawn[j];
    return tips_apart_m(angles) - kTouching_m;
  };
  if (gap(open) < 0 || gap(closed) > 0) return std::nullopt;
  for (int i = 0; i < 40; ++i)
    (gap((open + closed) / 2) > 0 ? open : closed) = (open + closed) / 2;
  return angles;
}

HandAngles loose_pinch() {
  HandAngles angles{};
  const std::array<double, 8> degrees{-8, 18, 40, 30, 0, 64, 44, 24};
  for (std::size_t j = 0; j < angles.size(); ++j)
    angles[j] = (j < 8 ? degrees[j] : j % 4 == 0 ? 0 : 20) * kCalibrationDegree;
  return angles;
}

HandAngles pinch_of_mechane() {
  return pinch_like(loose_pinch()).value();
}

HandAngles any_pinch() {
  const auto near_it = rc::gen::exec([] {
    HandAngles angles = loose_pinch();
    for (std::size_t j = 0; j < 8; ++j)
      angles[j] += *test::between(-6, 6) * kCalibrationDegree;
    return angles;
  });
  return *pinch_like(
      *rc::gen::suchThat(near_it, [](const HandAngles& angles) { return pinch_like(angles).has_value(); }));
}

/// Shows a pose for as long as it is asked for; true hands tremble, and the first moments are on the way to the pose.
class Visitor {
 public:
  explicit Visitor(const WrongGlove& glove) : glove_(glove) {}

  [[nodiscard]] Expected<void> show(CalibrationPose pose, const HandAngles& truth) {
    calibrator_.begin(pose);
    const TimePoint begun = now_;
    std::uniform_real_distribution<double> tremor(-tremor_rad, tremor_rad);
    bool enough = false;
    for (int i = 0; !enough && i < 2000; ++i, now_ += 5ms) {
      HandAngles raw = glove_.reads(truth);
      for (double& angle : raw)
        angle += tremor(random_) + (now_ - begun < on_the_way ? 0.7 : 0);
      if (unplugged_each > 0 && i % unplugged_each == 0)
        raw[static_cast<std::size_t>(i / unplugged_each) % 20] = kNotANumber;
      enough = calibrator_.add(now_, raw);
    }
    EXPECT_TRUE(enough);
    return calibrator_.end();
  }
  [[nodiscard]] Expected<HandCalibration> show_all(const HandAngles& flat, const HandAngles& fist,
                                                   const HandAngles& pinch) {
    for (const auto& [pose, truth] : {std::pair{CalibrationPose::flat, flat}, std::pair{CalibrationPose::fist, fist},
                                      std::pair{CalibrationPose::pinch, pinch}})
      if (auto shown = show(pose, truth); !shown) return tl::unexpected(shown.error());
    return calibrator_.result();
  }
  [[nodiscard]] Expected<HandCalibration> result() const { return calibrator_.result(); }
  [[nodiscard]] client::PoseRefusal refusal() const { return calibrator_.refusal(); }
  [[nodiscard]] Duration lasted() const { return now_.time_since_epoch(); }

  double tremor_rad = 0.02;
  Duration on_the_way = 200ms;
  int unplugged_each = 0;  ///< each so many-th sample has a number that is not finite

 private:
  WrongGlove glove_;
  HandCalibrator calibrator_;
  TimePoint now_;
  std::mt19937 random_{7};  // NOLINT: the same tremor each time
};

HandAngles with_thumb_shifted(HandAngles angles, double by) {
  for (std::size_t j = 0; j < hand::kFingerJoints; ++j)
    angles[j] += by;
  return angles;
}

TEST(HandCalibration, AnyGlovesAnglesBecomeThoseOfTheHand) {
  EXPECT_TRUE(rc::check([] {
    const WrongGlove glove = any_glove();
    const HandAngles pinch = any_pinch();
    Visitor visitor(glove);
    const auto calibration = visitor.show_all({}, model_pose(CalibrationPose::fist), pinch);
    RC_ASSERT(calibration.has_value());
    HandAngles truth;
    for (std::size_t j = 0; j < truth.size(); ++j)
      truth[j] = j % 4 == 0 ? *test::between(-0.4, 0.4) : *test::between(-0.3, 1.2);
    const HandAngles angles = calibration->apply(glove.reads(truth));
    for (std::size_t j = 0; j < truth.size(); ++j)
      RC_ASSERT(std::abs(angles[j] - truth[j]) < 0.04);
    RC_ASSERT(std::abs(tips_apart_m(calibration->apply(glove.reads(pinch))) - kTouching_m) < 0.002);
    RC_ASSERT(visitor.lasted() < 30s);
  }));
}

TEST(HandCalibration, ThumbAndIndexFingerMeetInAPinchThatTheGloveSeesApart) {
  for (const double by : {-0.25, -0.1, 0.1, 0.25}) {
    Visitor visitor(right_glove());
    visitor.tremor_rad = 0;
    const HandAngles pinch = with_thumb_shifted(pinch_of_mechane(), by);
    ASSERT_GT(std::abs(tips_apart_m(pinch) - kTouching_m), 0.004) << by;
    const auto calibration = visitor.show_all({}, model_pose(CalibrationPose::fist), pinch);
    ASSERT_TRUE(calibration) << calibration.error().to_string();
    EXPECT_NEAR(tips_apart_m(calibration->apply(pinch)), kTouching_m, 1e-4);
    for (std::size_t j = 0; j < hand::kHandJoints; ++j) {
      EXPECT_NEAR(calibration->joints[j].gain, 1, 1e-9) << j;
      const double offset_rad = j < hand::kFingerJoints ? 0 : calibration->joints[j].offset_rad;
      EXPECT_NEAR(offset_rad, 0, 1e-9) << j;
    }
  }
}

TEST(HandCalibration, MechanesOwnHandFitsARightGloveAsItIs) {
  Visitor visitor(right_glove());
  visitor.tremor_rad = 0;
  const auto calibration = visitor.show_all(model_pose(CalibrationPose::flat), model_pose(CalibrationPose::fist),
                                            model_pose(CalibrationPose::pinch));
  ASSERT_TRUE(calibration) << calibration.error().to_string();
  for (const JointCalibration& joint : calibration->joints) {
    EXPECT_NEAR(joint.gain, 1, 1e-9);
    EXPECT_NEAR(joint.offset_rad, 0, 0.002);
  }
}

TEST(HandCalibration, AnglesStayWithinWhatJointsCanDo) {
  Visitor visitor(right_glove());
  const auto calibration = visitor.show_all({}, model_pose(CalibrationPose::fist), pinch_of_mechane());
  ASSERT_TRUE(calibration);
  for (const double far : {-100.0, 100.0}) {
    HandAngles raw;
    raw.fill(far);
    for (const double angle : calibration->apply(raw))
      EXPECT_LT(std::abs(angle), 2.3);
  }
}

TEST(HandCalibration, SamplesThatAreNoNumbersAreIgnored) {
  Visitor visitor(right_glove());
  visitor.unplugged_each = 3;
  const auto calibration = visitor.show_all({}, model_pose(CalibrationPose::fist), pinch_of_mechane());
  ASSERT_TRUE(calibration) << calibration.error().to_string();
  for (const double angle : calibration->apply(model_pose(CalibrationPose::fist)))
    EXPECT_TRUE(std::isfinite(angle));
  EXPECT_NEAR(calibration->apply(model_pose(CalibrationPose::fist))[5], model_pose(CalibrationPose::fist)[5], 0.02);
}

TEST(HandCalibration, AGloveThatGivesNoNumbersIsRefused) {
  HandCalibrator calibrator;
  calibrator.begin(CalibrationPose::flat);
  HandAngles raw{};
  raw[19] = kNotANumber;
  for (int i = 0; i < 1000; ++i)
    EXPECT_FALSE(calibrator.add(TimePoint(i * 5ms), raw));
  const auto ended = calibrator.end();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().code, ErrorCode::missing);
  EXPECT_FALSE(ended.error().remedy.empty());
}

TEST(HandCalibration, APoseIsShownForThreeSeconds) {
  HandCalibrator calibrator;
  calibrator.begin(CalibrationPose::flat);
  for (auto at = 0ms; at < 2900ms; at += 10ms)
    EXPECT_FALSE(calibrator.add(TimePoint(at), {}));
  EXPECT_NEAR(calibrator.share(), 2890.0 / 3000, 1e-9);
  EXPECT_FALSE(calibrator.end());
  EXPECT_EQ(calibrator.refusal(), client::PoseRefusal::unseen);
  calibrator.begin(CalibrationPose::flat);
  EXPECT_EQ(calibrator.share(), 0);
  EXPECT_FALSE(calibrator.add(TimePoint(0ms), {}));
  EXPECT_TRUE(calibrator.add(TimePoint(4000ms), {}));
  EXPECT_FALSE(calibrator.end()) << "two samples are no three seconds";
}

TEST(HandCalibration, AHandThatMovesIsRefusedAndMayTryAgain) {
  Visitor visitor(right_glove());
  visitor.tremor_rad = 0.3;
  const auto moved = visitor.show(CalibrationPose::flat, {});
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().code, ErrorCode::invalid_value);
  EXPECT_EQ(moved.error().where, "flat hand");
  EXPECT_EQ(visitor.refusal(), client::PoseRefusal::moved);
  EXPECT_FALSE(moved.error().remedy.empty());
  visitor.tremor_rad = 0.02;
  EXPECT_TRUE(visitor.show_all({}, model_pose(CalibrationPose::fist), pinch_of_mechane()));
}

TEST(HandCalibration, PosesThatAreSwappedOrTooMuchAlikeAreRefused) {
  const HandAngles flat{}, fist = model_pose(CalibrationPose::fist), pinch = pinch_of_mechane();
  HandAngles half_fist = fist;
  for (double& angle : half_fist)
    angle *= 0.1;
  HandAngles thumb_away = pinch;
  for (std::size_t j = 0; j < hand::kFingerJoints; ++j)
    thumb_away[j] = 0;
  struct Case {
    const char* what;
    HandAngles flat, fist, pinch;
    const char* where;
  };
  for (const Case& c :
       {Case{"flat hand and fist swapped", fist, flat, pinch, "flat hand and fist"},
        Case{"fist and pinch swapped", flat, pinch, fist, "fist"},
        Case{"flat hand and pinch swapped", pinch, fist, flat, "pinch"}, Case{"all the same", flat, flat, flat, "fist"},
        Case{"hardly a fist", flat, half_fist, pinch, "fist"}, Case{"no pinch", flat, fist, flat, "pinch"},
        Case{"a fist again", flat, fist, fist, "pinch"}, Case{"the thumb stays", flat, fist, thumb_away, "pinch"}}) {
    Visitor visitor(right_glove());
    const auto calibration = visitor.show_all(c.flat, c.fist, c.pinch);
    ASSERT_FALSE(calibration) << c.what;
    EXPECT_EQ(calibration.error().where, c.where) << c.what;
    const bool swapped = calibration.error().code == ErrorCode::conflict;
    EXPECT_EQ(visitor.refusal(), swapped ? client::PoseRefusal::swapped : client::PoseRefusal::unlike) << c.what;
    EXPECT_FALSE(calibration.error().remedy.empty()) << c.what;
    EXPECT_FALSE(visitor.result()) << c.what;
  }
}

TEST(HandCalibration, AFingerThatDoesNotBendIsNamed) {
  HandAngles fist = model_pose(CalibrationPose::fist);
  fist[4 * 3 + 2] = 0.1;
  Visitor visitor(right_glove());
  const auto calibration = visitor.show_all({}, fist, pinch_of_mechane());
  ASSERT_FALSE(calibration);
  EXPECT_NE(calibration.error().what.find("ring finger"), std::string::npos) << calibration.error().to_string();
}

TEST(HandCalibration, APinchThatIsTooFarApartIsRefused) {
  HandAngles pinch = pinch_of_mechane();
  pinch[0] = 1.0;
  pinch[1] = pinch[2] = pinch[3] = -0.6;
  Visitor visitor(right_glove());
  const auto calibration = visitor.show_all({}, model_pose(CalibrationPose::fist), pinch);
  ASSERT_FALSE(calibration);
  EXPECT_EQ(calibration.error().where, "pinch");
}

TEST(HandCalibration, APoseThatIsMissingIsNamed) {
  Visitor visitor(right_glove());
  ASSERT_TRUE(visitor.show(CalibrationPose::flat, {}));
  ASSERT_TRUE(visitor.show(CalibrationPose::pinch, pinch_of_mechane())) << "in any order";
  EXPECT_EQ(visitor.result().error().where, "fist");
  ASSERT_TRUE(visitor.show(CalibrationPose::fist, model_pose(CalibrationPose::fist)));
  EXPECT_TRUE(visitor.result());
}

}  // namespace
}  // namespace mechane::haptic
