#include "client-sdk/haptic/calibration_course.hpp"

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
  if (++pose_ < kCalibrationPoses) return ask(now, "");
  result_ = calibrator_.result();
  return "the three poses are taken";
}

std::optional<std::string> CalibrationCourse::add(TimePoint now, const HandAngles* raw) {
  if (result_) return {};
  if (!begun_) {
    begun_ = true;
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

}  // namespace mechane::haptic
