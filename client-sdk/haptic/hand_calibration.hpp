// A visitor's hand in a glove: three poses, of three seconds each, say how the glove's angles become those of Mechane's
// hand. They are measures of a person's body: they stay in memory, and nothing here writes them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/hand/calibration_pose.hpp"
#include <mechane/client/types.hpp>

namespace mechane::haptic {

using hand::CalibrationPose;
using hand::HandAngles;
using hand::kCalibrationPoses;

/// What a visitor does to show the pose, as it is said to the visitor.
[[nodiscard]] const char* how_to_show(CalibrationPose pose) noexcept;

/// angle = gain * raw + offset_rad, from least_rad to most_rad.
struct JointCalibration {
  double gain = 1;
  double offset_rad = 0;
  double least_rad = -kPi;
  double most_rad = kPi;
};

struct HandCalibration {
  std::array<JointCalibration, hand::kHandJoints> joints{};

  /// From a glove's finite angles to those of Mechane's hand. Any thread; allocates nothing.
  [[nodiscard]] HandAngles apply(const HandAngles& raw) const noexcept;
};

/// Collects the poses: begin() one, add() samples until it returns true, end() it. A pose that end() refuses is shown
/// again. result() needs all three, in any order. One thread.
class HandCalibrator {
 public:
  static constexpr Duration kPoseLasts = std::chrono::seconds(3);

  HandCalibrator();

  /// Whatever was shown of this pose before no longer counts.
  void begin(CalibrationPose pose) noexcept;
  /// A glove's angles at `at`, from while it is ready. Samples with a number that is not finite are ignored, and so are
  /// more than 125 a second. True: the pose has lasted long enough. Allocates nothing.
  bool add(TimePoint at, const HandAngles& raw) noexcept;
  /// Takes the median of each joint. Errors: too few samples, the hand moved, the pose is too much like another one or
  /// swapped with it, thumb and index finger of Mechane's hand cannot meet. They say which, and what to do.
  [[nodiscard]] Expected<void> end();
  /// Why the last end() did not take the pose.
  [[nodiscard]] client::PoseRefusal refusal() const noexcept { return refusal_; }
  /// How much of kPoseLasts the pose that has begun was shown, 0..1.
  [[nodiscard]] double share() const noexcept;

  /// The flat hand reads as 0, and the fist as the model's; then the thumb's offsets are changed by as little as makes
  /// the tips of thumb and index finger touch in the pinch. No pose spreads the fingers: their abductions keep the
  /// glove's gain. So do joints of the thumb that the fist does not tell of. Errors: a pose is missing.
  [[nodiscard]] Expected<HandCalibration> result() const;

 private:
  using Poses = std::array<std::optional<HandAngles>, kCalibrationPoses>;

  CalibrationPose pose_ = CalibrationPose::flat;
  client::PoseRefusal refusal_ = client::PoseRefusal::none;
  std::vector<HandAngles> samples_;  // of pose_
  TimePoint first_, last_;
  Poses poses_;
};

}  // namespace mechane::haptic
