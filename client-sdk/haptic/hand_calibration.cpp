#include "client-sdk/haptic/hand_calibration.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "server/hand/hand_skeleton.hpp"

namespace mechane::haptic {
namespace {

using namespace std::chrono_literals;
using FingerAngles = std::array<double, hand::kFingerJoints>;

constexpr double kDegree = kPi / 180;
constexpr Duration kSampleEvery = 8ms;
constexpr std::size_t kFewestSamples = 30;
constexpr double kMostMotion_rad = 0.15;  // of four fifths of the samples, in the glove's angles

// In the glove's angles, which are wrong by half at most.
constexpr double kLeastBend = 0.25;  // of a finger's joint, as a share of the fist's
constexpr double kSwapped_rad = 1;   // of all joints together
constexpr double kLeastThumbMotion_rad = 0.15;
constexpr double kLeastPinch = 0.1, kMostPinch = 0.85;           // of the index finger's bend, as a share of the fist's
constexpr double kLeastThumbShare = 0.4, kMostThumbShare = 2.5;  // of a joint's motion, against the model's

constexpr double kMostThumbShift_rad = 0.7;
constexpr double kTouch_m = 1e-5;

constexpr const char* kFingerNames[] = {"thumb", "index finger", "middle finger", "ring finger", "little finger"};
constexpr const char* kJointNames[] = {"sideways", "at its first joint", "at its middle joint", "at its last joint"};

struct PoseName {
  const char* name;
  const char* how;
};
constexpr PoseName kPoses[] = {
    {"flat hand", "lay the hand flat, fingers together and thumb stretched out to the side, and hold it still"},
    {"fist", "make a fist, thumb across the fingers, and hold it still"},
    {"pinch", "put the tip of the thumb on the tip of the index finger, and hold them still"}};

const PoseName& name_of(CalibrationPose pose) {
  return kPoses[static_cast<std::size_t>(pose)];
}

tl::unexpected<Error> refused(CalibrationPose pose, std::string what) {
  return fail(ErrorCode::invalid_value, std::move(what), name_of(pose).name, name_of(pose).how);
}

/// What joints of Mechane's hand can do.
JointCalibration joint_limits(std::size_t joint) {
  struct Range {
    double least_deg, most_deg;
  };
  constexpr std::array<Range, hand::kFingerJoints> kThumb{{{-60, 60}, {-60, 70}, {-45, 90}, {-45, 100}}};
  constexpr std::array<Range, hand::kFingerJoints> kFinger{{{-45, 45}, {-45, 110}, {-20, 130}, {-45, 100}}};
  const std::size_t k = joint % hand::kFingerJoints;
  const Range& range = joint < hand::kFingerJoints ? kThumb[k] : kFinger[k];
  JointCalibration limits;
  limits.least_rad = range.least_deg * kDegree;
  limits.most_rad = range.most_deg * kDegree;
  return limits;
}

FingerAngles finger_of(const HandAngles& angles, std::size_t finger) {
  FingerAngles own;
  std::copy_n(angles.begin() + hand::kFingerJoints * finger, own.size(), own.begin());
  return own;
}

double bend_of(const HandAngles& angles, std::size_t finger) {
  const FingerAngles own = finger_of(angles, finger);
  return own[1] + own[2] + own[3];
}

/// The share that is in the middle of all values when they are sorted: 0.5 is the median.
double quantile(std::vector<double>& values, double share) {
  const auto at = values.begin() + std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Expected<void> compare(const HandAngles& flat, const HandAngles& fist) {
  double closed = 0;
  for (std::size_t f = 1; f < hand::kFingers; ++f)
    closed += bend_of(fist, f) - bend_of(flat, f);
  if (closed < -kSwapped_rad)
    return fail(ErrorCode::conflict, "the fist is more open than the flat hand", "flat hand and fist",
                "show both again, first the flat hand and then the fist");
  const HandAngles model = model_pose(CalibrationPose::fist);
  for (std::size_t j = hand::kFingerJoints; j < hand::kHandJoints; ++j) {
    const double bend = fist[j] - flat[j];
    if (model[j] == 0 || bend >= kLeastBend * model[j]) continue;
    return refused(
        CalibrationPose::fist,
        std::string("the ") + kFingerNames[j / hand::kFingerJoints] + " bends too little " +
            kJointNames[j % hand::kFingerJoints] +
            " from the flat hand to the fist; if it does so again, show the flat hand again, or check the glove");
  }
  return {};
}

Expected<void> compare(const HandAngles& flat, const HandAngles& fist, const HandAngles& pinch) {
  const double share = (bend_of(pinch, 1) - bend_of(flat, 1)) / (bend_of(fist, 1) - bend_of(flat, 1));
  if (share < kLeastPinch)
    return refused(CalibrationPose::pinch, "the index finger is as straight as in the flat hand, or straighter");
  if (share > kMostPinch)
    return refused(CalibrationPose::pinch, "the index finger is as closed as in the fist, or more");
  double motion = 0;
  for (std::size_t j = 0; j < hand::kFingerJoints; ++j)
    motion += std::abs(pinch[j] - flat[j]);
  if (motion < kLeastThumbMotion_rad)
    return refused(CalibrationPose::pinch, "the thumb is where it was in the flat hand");
  return {};
}

/// The middle of a finger's round end, in H.
Vec3 tip_of(std::size_t finger, const FingerAngles& angles) {
  const hand::FingerSizes sizes = hand::middle_sized_fingers();
  const hand::FingerSize& size = sizes[finger];
  std::array<Pose, hand::kPhalanges> X_HS;
  hand::place_finger(sizes, finger, {}, angles, Pose{}, X_HS);
  return X_HS.back() * Vec3((size.length_m.back() - size.radius_m.back()) / 2, 0, 0);
}

/// The thumb's angles nearest to `thumb` that make its tip touch that of the index finger: Newton's steps of the least
/// length. None where it cannot.
std::optional<FingerAngles> thumb_that_touches(const FingerAngles& index, FingerAngles thumb) {
  constexpr int kSteps = 100;
  constexpr double kStep_rad = 0.1, kDifference_rad = 1e-5;
  const hand::FingerSizes sizes = hand::middle_sized_fingers();
  const double touching_m = sizes[0].radius_m.back() + sizes[1].radius_m.back();
  const Vec3 p_HI = tip_of(1, index);
  const auto gap_m = [&](const FingerAngles& angles) { return (tip_of(0, angles) - p_HI).norm() - touching_m; };
  for (int step = 0; step < kSteps; ++step) {
    const double gap = gap_m(thumb);
    if (std::abs(gap) < kTouch_m) return thumb;
    Eigen::Vector4d slope;
    for (std::size_t j = 0; j < thumb.size(); ++j) {
      FingerAngles moved = thumb;
      moved[j] += kDifference_rad;
      slope[static_cast<int>(j)] = (gap_m(moved) - gap) / kDifference_rad;
    }
    Eigen::Vector4d change = -gap / std::max(slope.squaredNorm(), 1e-9) * slope;
    if (change.norm() > kStep_rad) change *= kStep_rad / change.norm();
    for (std::size_t j = 0; j < thumb.size(); ++j) {
      const JointCalibration limits = joint_limits(j);
      thumb[j] = std::clamp(thumb[j] + change[static_cast<int>(j)], limits.least_rad, limits.most_rad);
    }
  }
  return std::nullopt;
}

/// Flat hand and fist become the model's.
JointCalibration joint_between(std::size_t joint, double flat, double fist) {
  JointCalibration calibration = joint_limits(joint);
  const double wanted = model_pose(CalibrationPose::fist)[joint];
  const double share = wanted != 0 ? (fist - flat) / wanted : 1;
  // A thumb lies in everybody's fist in its own way: where it tells little, the glove knows better.
  const bool tells = joint >= hand::kFingerJoints || (share >= kLeastThumbShare && share <= kMostThumbShare);
  calibration.gain = tells ? 1 / share : 1;
  calibration.offset_rad = -calibration.gain * flat;
  return calibration;
}

Expected<HandCalibration> make(const HandAngles& flat, const HandAngles& fist, const HandAngles& pinch) {
  HandCalibration calibration;
  for (std::size_t j = 0; j < hand::kHandJoints; ++j)
    calibration.joints[j] = joint_between(j, flat[j], fist[j]);
  const HandAngles angles = calibration.apply(pinch);
  const auto thumb = thumb_that_touches(finger_of(angles, 1), finger_of(angles, 0));
  double most = 0;
  for (std::size_t j = 0; thumb && j < thumb->size(); ++j) {
    // Not from the angle after the limits: the offset moves what comes before them.
    JointCalibration& joint = calibration.joints[j];
    const double shift = (*thumb)[j] - (joint.gain * pinch[j] + joint.offset_rad);
    joint.offset_rad += shift;
    most = std::max(most, std::abs(shift));
  }
  if (!thumb || most > kMostThumbShift_rad)
    return refused(CalibrationPose::pinch, "the thumb is too far from the index finger's tip");
  return calibration;
}

/// The median of each joint.
Expected<HandAngles> still_pose(CalibrationPose pose, const std::vector<HandAngles>& samples) {
  HandAngles middle;
  std::vector<double> values(samples.size());
  for (std::size_t j = 0; j < middle.size(); ++j) {
    std::ranges::transform(samples, values.begin(), [&](const HandAngles& sample) { return sample[j]; });
    const double motion = quantile(values, 0.9) - quantile(values, 0.1);
    if (motion > kMostMotion_rad)
      return refused(pose, std::string("the ") + kFingerNames[j / hand::kFingerJoints] + " moved " +
                               kJointNames[j % hand::kFingerJoints]);
    middle[j] = quantile(values, 0.5);
  }
  return middle;
}

/// Those that were shown.
Expected<void> fit_together(const std::array<std::optional<HandAngles>, kCalibrationPoses>& poses) {
  const auto& [flat, fist, pinch] = poses;
  if (flat && fist)
    if (auto differ = compare(*flat, *fist); !differ) return differ;
  if (flat && fist && pinch) {
    if (auto differ = compare(*flat, *fist, *pinch); !differ) return differ;
    if (auto made = make(*flat, *fist, *pinch); !made) return tl::unexpected(made.error());
  }
  return {};
}

}  // namespace

const char* how_to_show(CalibrationPose pose) noexcept {
  return name_of(pose).how;
}

HandAngles HandCalibration::apply(const HandAngles& raw) const noexcept {
  HandAngles angles;
  for (std::size_t j = 0; j < angles.size(); ++j)
    angles[j] = std::clamp(joints[j].gain * raw[j] + joints[j].offset_rad, joints[j].least_rad, joints[j].most_rad);
  return angles;
}

HandCalibrator::HandCalibrator() {
  samples_.reserve(static_cast<std::size_t>(kPoseLasts / kSampleEvery) + 2);
}

void HandCalibrator::begin(CalibrationPose pose) noexcept {
  pose_ = pose;
  poses_[static_cast<std::size_t>(pose)].reset();
  samples_.clear();
}

bool HandCalibrator::add(TimePoint at, const HandAngles& raw) noexcept {
  const bool whole = !samples_.empty() && last_ - first_ >= kPoseLasts;
  if (whole || !std::ranges::all_of(raw, [](double angle) { return std::isfinite(angle); })) return whole;
  if (samples_.empty())
    first_ = at;
  else if (at - last_ < kSampleEvery)
    return false;
  last_ = at;
  samples_.push_back(raw);
  return last_ - first_ >= kPoseLasts;
}

double HandCalibrator::share() const noexcept {
  if (samples_.empty()) return 0;
  return std::min(1.0, to_seconds(last_ - first_) / to_seconds(kPoseLasts));
}

Expected<void> HandCalibrator::end() {
  using client::PoseRefusal;
  const std::vector<HandAngles> samples = std::exchange(samples_, {});
  samples_.reserve(samples.capacity());
  refusal_ = PoseRefusal::unseen;
  if (samples.size() < kFewestSamples || last_ - first_ < kPoseLasts)
    return fail(ErrorCode::missing, "it was not shown for three seconds, or the glove gave hardly any angles",
                name_of(pose_).name, "hold the pose until it is enough, and check that the glove is ready");
  refusal_ = PoseRefusal::moved;
  const auto middle = still_pose(pose_, samples);
  if (!middle) return tl::unexpected(middle.error());
  Poses poses = poses_;
  poses[static_cast<std::size_t>(pose_)] = *middle;
  if (auto fit = fit_together(poses); !fit) {
    refusal_ = fit.error().code == ErrorCode::conflict ? PoseRefusal::swapped : PoseRefusal::unlike;
    return fit;
  }
  refusal_ = PoseRefusal::none;
  poses_ = poses;
  return {};
}

Expected<HandCalibration> HandCalibrator::result() const {
  for (std::size_t p = 0; p < poses_.size(); ++p)
    if (!poses_[p]) return fail(ErrorCode::missing, "this pose has not been shown", kPoses[p].name, kPoses[p].how);
  return make(*poses_[0], *poses_[1], *poses_[2]);
}

}  // namespace mechane::haptic
