// Leads a visitor through the poses of a HandCalibrator: what the kiosk's displays show, and messages in a terminal.
#pragma once

#include <optional>
#include <string>

#include "client-sdk/haptic/device.hpp"
#include "client-sdk/haptic/hand_calibration.hpp"
#include "client-sdk/haptic/hand_motion.hpp"

namespace mechane::haptic {

/// Waits until fingers move in the glove. Then flat, fist, pinch: each announced, held still for kPoseLasts after kSettle, and asked for
/// again where it was refused. Under 30 s where none is. One thread.
class CalibrationCourse {
 public:
  static constexpr Duration kSettle = std::chrono::seconds(2);
  static constexpr int kTries = 3;  ///< of one pose; then the course fails

  /// The glove's angles at `now`; null: it is not ready. Returns what to tell the visitor, where there is something new.
  [[nodiscard]] std::optional<std::string> add(TimePoint now, const HandAngles* raw);

  /// For the displays.
  [[nodiscard]] client::CalibrationNews news() const noexcept;
  /// What visitors are told of the glove meanwhile: what is the matter with it; that it is let go, while a hand is waited for; or that it
  /// is being prepared.
  [[nodiscard]] client::DeviceState device_state(DeviceCondition condition) const noexcept;
  /// None while the course goes on.
  [[nodiscard]] const std::optional<Expected<HandCalibration>>& result() const noexcept { return result_; }

 private:
  [[nodiscard]] std::string ask(TimePoint now, const std::string& before);
  [[nodiscard]] std::string next_pose(TimePoint now);

  HandCalibrator calibrator_;
  HandMotion motion_;
  std::size_t pose_ = 0;
  int tries_ = 0;                                           // of this pose
  int starts_ = 1;                                          // of the course
  enum class Phase : std::uint8_t { begins, waits, asks };  // waits: for a hand in the glove
  Phase phase_ = Phase::begins;
  client::PoseRefusal refusal_ = client::PoseRefusal::none;
  bool recording_ = false;
  TimePoint asked_;
  std::optional<Expected<HandCalibration>> result_;
};

}  // namespace mechane::haptic
