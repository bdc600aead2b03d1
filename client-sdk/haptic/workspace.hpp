// Where a device's workspace lies in the world, and how large it is there.
#pragma once

#include <cstdint>

#include "server/base/math.hpp"
#include <mechane/client/devices.hpp>

namespace mechane::haptic {

struct WorkspaceConfig {
  client::DevicePlace place{};
  std::uint32_t clutch_button =
      0;  ///< bits of mechane_device_state.buttons; while one is down, the hand stays where it is
};

/// One hand. One thread; allocates nothing.
class Workspace {
 public:
  explicit Workspace(const WorkspaceConfig& config) : clutch_button_(config.clutch_button), p_WH_(config.place.p_WD) {
    put(config.place);
  }

  /// Elsewhere, with what follow() hears next. What the clutch has moved is forgotten.
  void put(const client::DevicePlace& place) noexcept {
    scale_ = place.scale;
    R_WD_ = Eigen::AngleAxisd(place.turn_rad, Vec3::UnitY());
    p_WD_ = place.p_WD;
  }

  /// Takes note of the device's newest state; true while the clutch is down: the device may be moved to another part of its workspace,
  /// and renders no force.
  bool follow(const Vec3& p_DH, std::uint32_t buttons) noexcept {
    const bool clutched = (buttons & clutch_button_) != 0;
    const Vec3 moved_W = scale_ * (R_WD_ * p_DH);
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
  [[nodiscard]] Vec3 to_device(const Vec3& force_W) const noexcept { return R_WD_.conjugate() * force_W / scale_; }

 private:
  std::uint32_t clutch_button_;
  double scale_ = 1;
  Quat R_WD_ = Quat::Identity();
  Vec3 p_WD_ = Vec3::Zero();
  Vec3 p_WH_;
};

}  // namespace mechane::haptic
