// From the bytes of a CyberGlove's sensors to the angles of the joints.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "client-sdk/drivers/cyberglove/record.hpp"
#include <mechane/driver.h>

namespace mechane::drivers {

/// angle = gain_rad * (byte - offset). Abductions are angles between neighbours, and grow as the fingers spread.
struct SensorGain {
  double gain_rad = 0;
  double offset = 0;
};

class GloveCalibration {
 public:
  /// Nominal gains: a joint is straight at byte 70, neighbours are together at byte 100, and 120 steps more are the end
  /// of the range. Ranges of flexion are those of the American Academy of Orthopaedic Surgeons: fingers 90, 100 and 90
  /// degrees, thumb 50 and 80. The thumb's roll and the abductions have 45. Real gloves on real hands differ from this
  /// by half, by the calibrations in asr-ros/asr_cyberglove_lib. `sensors`: 18 or 22.
  explicit GloveCalibration(std::size_t sensors) noexcept;

  /// Takes the text of a calibration file instead: a line "GAIN OFFSET" for each sensor in the glove's order. GAIN is
  /// in radians a step, OFFSET is the byte at which the angle is 0; '#' begins a comment. Returns what is wrong with
  /// the text, for a person; then nothing has changed. Empty: it is right.
  [[nodiscard]] std::string take_text(std::string_view text);

  /// Angles as driver.h orders them, radians. Abduction is positive towards the thumb, and 0 for the middle finger. The
  /// sensors of the palm's arch and of the wrist are not used. With 18 sensors the fingers' outer joints bend by two
  /// thirds of the middle ones [Rijpkema and Girard, Computer animation of knowledge-based human grasping, SIGGRAPH
  /// 1991]. Any thread; allocates nothing.
  void place_joints(const GloveRecord& record, double (&joints_rad)[MECHANE_HAND_JOINTS]) const noexcept;

 private:
  [[nodiscard]] double angle(const GloveRecord& record, std::size_t sensor) const noexcept;

  std::size_t sensors_;
  std::array<SensorGain, kGloveSensors> gains_{};  // in the glove's order
};

/// 0 open .. 1 closed: the mean bend of the four fingers. A fist leaves the thumb half open.
[[nodiscard]] double grasp_of(const double (&joints_rad)[MECHANE_HAND_JOINTS]) noexcept;

}  // namespace mechane::drivers
