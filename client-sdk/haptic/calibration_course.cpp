#include "client-sdk/haptic/calibration_course.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mechane::haptic {

std::string CalibrationCourse::ask(TimePoint now, const std::string& before) {
  ++tries_;
  recording_ = false;
  asked_ = now;
  return before + std::to_string(pose_ + 1) + " of " + std::to_string(kCalibrationPoses) + ": " +
         how_to_show(static_cast<CalibrationPose>(pose_));
}

/// After a pose that was taken.
std::string CalibrationCourse::next_pose(TimePoint now) {
  tries_ = 0;
  refusal_ = client::PoseRefusal::none;
  if (++pose_ < kCalibrationPoses) return ask(now, "");
  result_ = calibrator_.result();
  return "the three poses are taken";
}

std::optional<std::string> CalibrationCourse::add(TimePoint now, const HandAngles* raw) {
  if (result_) return {};
  if (phase_ != Phase::asks) {
    const bool begins = std::exchange(phase_, Phase::waits) == Phase::begins;
    const bool moves = raw != nullptr && motion_.note(now, *raw);
    if (!moves) return begins ? std::optional<std::string>("put the glove on, and move the fingers") : std::nullopt;
    phase_ = Phase::asks;
    return ask(now, "");
  }
  if (now - asked_ < kSettle) return {};
  if (!recording_) {
    recording_ = true;
    calibrator_.begin(static_cast<CalibrationPose>(pose_));
  }
  const bool in_time =
      now - asked_ < kSettle + 3 * HandCalibrator::kPoseLasts;  // a glove that is not ready gives nothing
  if (in_time && (raw == nullptr || !calibrator_.add(now, *raw))) return {};
  const auto ended = calibrator_.end();
  if (ended) return next_pose(now);
  refusal_ = calibrator_.refusal();
  if (ended.error().code == ErrorCode::conflict &&
      starts_ < kTries) {  // two poses do not fit: the fault may be the first one's
    ++starts_;
    tries_ = 0;
    pose_ = 0;
    return ask(now, ended.error().what + "; once more from the beginning, ");
  }
  if (tries_ < kTries) return ask(now, ended.error().what + "; again, ");
  result_ = tl::unexpected(ended.error());
  return {};
}

client::CalibrationNews CalibrationCourse::news() const noexcept {
  using client::CalibrationStep;
  if (result_) return {.step = *result_ ? CalibrationStep::done : CalibrationStep::none};
  if (phase_ != Phase::asks) return {};
  // The tenth that has begun: a display fills its ring meanwhile.
  const double tenths = recording_ ? std::min(10.0, 1 + std::floor(10 * calibrator_.share())) : 0;
  return {client::kPoseSteps[pose_], static_cast<float>(tenths / 10), refusal_};
}

client::DeviceState CalibrationCourse::device_state(DeviceCondition condition) const noexcept {
  using client::DeviceState;
  // A glove that only reads the hand is missed as well: without a hand in it there is nothing to fit.
  const DeviceState known = state_for_visitors(condition, false, true);
  if (known != DeviceState::ready) return known;
  return phase_ == Phase::asks ? DeviceState::preparing : DeviceState::let_go;
}

}  // namespace mechane::haptic
