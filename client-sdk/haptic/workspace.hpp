// Where a device's workspace lies in the world, and how large it is there.
#pragma once

#include <cstdint>

#include "server/base/math.hpp"

namespace mechane::haptic {

struct WorkspaceConfig {
  Vec3 p_WD = Vec3::Zero();  ///< the middle of the device's workspace
  double turn_rad = 0;       ///< of the device about the world's y axis, anticlockwise from above
  double scale = 1;          ///< metres in the world for one of the device's; at least 1
  std::uint32_t clutch_button =
      0;  ///< bits of mechane_device_state.buttons; while one is down, the hand stays where it is
};

/// One hand. One thread; allocates nothing.
class Workspace {
 public:
  explicit Workspace(const WorkspaceConfig& config)
      : config_(config), R_WD_(Eigen::AngleAxisd(config.turn_rad, Vec3::UnitY())), p_WD_(config.p_WD) {}

  /// Takes note of the device's newest state; true while the clutch is down: the device may be moved to another part of its workspace,
  /// and renders no force.
  bool follow(const Vec3& p_DH, std::uint32_t buttons) noexcept {
    const bool clutched = (buttons & config_.clutch_button) != 0;
    const Vec3 moved_W = config_.scale * (R_WD_ * p_DH);
    if (clutched) {
      p_WD_ = p_WH_ - moved_W;
    } else {
      p_WH_ = p_WD_ + moved_W;
    }
    return clutched;
  }
  [[nodiscard]] const Vec3& p_WH() const noexcept { return p_WH_; }
  [[nodiscard]] Quat R_WH(const Quat& R_DH) const noexcept { return R_WD_ * R_DH; }

  /// A force or torque for the device, divided by the scale: a wall is then no stiffer than with a scale of 1, and the hand gets no more
  /// energy from the device than the loop has counted in the world.
  [[nodiscard]] Vec3 to_device(const Vec3& force_W) const noexcept {
    return R_WD_.conjugate() * force_W / config_.scale;
  }

 private:
  WorkspaceConfig config_;
  Quat R_WD_;
  Vec3 p_WD_;
  Vec3 p_WH_ = p_WD_;
};

}  // namespace mechane::haptic
