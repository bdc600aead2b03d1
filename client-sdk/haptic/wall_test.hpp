// WallTest: a gentle wall under the hand, to try a device without a server.
#pragma once

#include <cstdint>

#include "client-sdk/haptic/device.hpp"
#include "server/hand/governor.hpp"

namespace mechane::haptic {

/// How the test goes.
struct WallReport {
  DeviceCondition condition = DeviceCondition::lost;
  bool was_lost = false;  ///< after its first state
  Vec3 p_WH = Vec3::Zero();
  double depth_m = 0;
  double force_n = 0;
  double force_max_n = 0;
  double finger_force_max_n = 0;
  double energy_out_j = 0;  ///< what the hand was given beyond what it gave; 0: none
  std::uint64_t ticks = 0;
};

/// A stylus feels a soft floor, 1 cm under where it was when it became ready; a glove, whose fingers can be held, feels them held once they
/// are half closed. No force over 1 N, or over what the device bears for long. The loop's thread.
class WallTest {
 public:
  /// The device must be open. `stiffest_n_per_m` of the device, 0: not known.
  [[nodiscard]] static Expected<WallTest> make(Device& device, double stiffest_n_per_m);

  /// Not `engaged`: what it renders is ramped down to zero.
  void tick(Duration dt, bool engaged = true) noexcept;
  [[nodiscard]] const WallReport& report() const noexcept { return report_; }
  /// Whether the last tick rendered exactly zero.
  [[nodiscard]] bool rests() const noexcept;

 private:
  WallTest(Device& device, double stiffness, const hand::ForceGovernor& governor)
      : device_(device), stiffness_(stiffness), governor_(governor), governed_(governor.start()) {}

  Device& device_;
  double stiffness_;
  hand::ForceGovernor governor_;
  hand::GovernorState governed_;
  hand::HandForce rendered_;
  Vec3 p_WF_ = Vec3::Zero();  // on the floor
  bool placed_ = false;
  double energy_j_ = 0;  // given to the hand, less what it gave
  WallReport report_;
};

}  // namespace mechane::haptic
