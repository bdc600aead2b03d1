// Devices without hardware: a simulated hand on which the forces act, so that visits can be played, tested and measured.
#pragma once

#include "client-sdk/haptic/device.hpp"

namespace mechane::haptic {

/// The pose that the simulated person intends for the hand at this moment.
struct HandIntent {
  client::HandKind kind = client::HandKind::one_point;
  Pose X_WH;                                         ///< the intended pose of the hand
  std::array<double, client::kHandJoints> joints{};  ///< finger angles, rad
  double grasp_intent = 0;
};

/// A device without hardware, in a hand that a program moves. intend() and the device's functions are called on the loop's
/// thread.
class SimulatedDevice : public Device {
 public:
  /// Where the hand that holds it wants to be from now on.
  virtual void intend(const HandIntent& intent) noexcept = 0;
  /// The force on it now, N.
  [[nodiscard]] virtual const Vec3& force_W() const noexcept = 0;
};

/// How a hand yields. A relaxed arm is soft: a force of 3 N moves this one by 5 mm.
struct ArmConfig {
  double mass_kg = 0.3;
  double stiffness_n_per_m = 600;
  double damping_ratio = 1;  ///< of critical
};

/// A hand on a spring: pulled towards the intended position, pushed by the rendered force. Its rotation follows the
/// intention without lag. It begins where it is first intended to be.
class VirtualDevice final : public SimulatedDevice {
 public:
  explicit VirtualDevice(const ArmConfig& arm = {}, client::HandSide side = client::HandSide::right)
      : arm_(arm), side_(side) {}

  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override;
  void write(const hand::HandForce& force) noexcept override { force_ = force; }
  /// Like a desktop stylus device of the Phantom class.
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }

  void intend(const HandIntent& intent) noexcept override;
  [[nodiscard]] const Vec3& force_W() const noexcept override { return force_.force_W.f; }

 private:
  ArmConfig arm_;
  client::HandSide side_;
  HandIntent intent_;
  Pose X_WH_;
  Twist V_WH_;
  hand::HandForce force_;
  bool placed_ = false;
};

}  // namespace mechane::haptic
