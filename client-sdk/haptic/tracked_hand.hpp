// A simulated hand before a camera. No device renders anything to it, and what is known of it comes 60 times a second, two pictures late,
// with each joint some tenths of a millimetre off.
#pragma once

#include <array>
#include <random>

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include "client-sdk/drivers/joints/hand_measure.hpp"
#include "client-sdk/haptic/virtual_device.hpp"

namespace mechane::haptic {

/// A whole hand, by way of the geometry of the driver `joints`. Its noise is the same each time.
class TrackedHand final : public SimulatedDevice {
 public:
  explicit TrackedHand(client::HandSide side = client::HandSide::right) : side_(side) {}
  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override;
  void write(const hand::HandForce& /*force*/) noexcept override {}
  /// Not there until its first picture has come.
  [[nodiscard]] DeviceCondition condition() const noexcept override {
    return was_told_ ? DeviceCondition::ready : DeviceCondition::lost;
  }
  /// Of no force at all.
  [[nodiscard]] hand::GovernorConfig limits() const override;
  [[nodiscard]] bool renders() const override { return false; }
  void intend(const HandIntent& intent) noexcept override { intent_ = intent; }
  [[nodiscard]] const Vec3& force_W() const noexcept override { return no_force_; }

 private:
  void take_picture();
  void set(drivers::HandPoint& point, const Vec3& p_D);
  void tell(const drivers::HandDatagram& seen);

  const Vec3 no_force_ = Vec3::Zero();
  client::HandSide side_;
  HandIntent intent_;
  std::array<drivers::HandDatagram, 2> on_the_way_;
  std::size_t pictures_ = 0;
  int since_told_ = 0;  // pictures since the last that showed a hand
  bool was_told_ = false;
  drivers::HandMeasure measure_;
  client::HandSample told_;
  Duration until_picture_{0};
  std::mt19937 random_{1};
};

}  // namespace mechane::haptic
