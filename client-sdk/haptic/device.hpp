// A haptic device as the loop sees it: gives the hand's position, takes the force to render.
#pragma once

#include "server/base/clock.hpp"
#include "server/hand/governor.hpp"
#include <mechane/client/types.hpp>

namespace mechane::haptic {

/// Whether a device may be given a force: only one that is ready. All but a lost one read the hand.
enum class DeviceCondition : std::uint8_t {
  ready,
  clutched,      ///< the hand is held in its place in the world while the device is moved
  let_go,        ///< its dead-man's switch is released
  not_ready,     ///< not held or not powered: the device does not tell which
  uncalibrated,  ///< somebody has to calibrate it
  hot,           ///< its motors are too warm for any force
  lost,          ///< gone or faulty: what read() gives is old
};

/// What visitors are told. `warm`: the force is lowered, to spare the motors. `renders`: the device can render forces; one that only reads
/// the hand is not missed while no hand is in it.
[[nodiscard]] constexpr client::DeviceState state_for_visitors(DeviceCondition condition, bool warm,
                                                               bool renders) noexcept {
  using client::DeviceState;
  switch (condition) {
    case DeviceCondition::ready:
    case DeviceCondition::clutched:
      break;
    case DeviceCondition::let_go:
      return renders ? DeviceState::let_go : DeviceState::ready;
    case DeviceCondition::not_ready:
      return renders ? DeviceState::not_ready : DeviceState::ready;
    case DeviceCondition::uncalibrated:
      return DeviceState::uncalibrated;
    case DeviceCondition::hot:
      return DeviceState::hot;
    case DeviceCondition::lost:
      return DeviceState::lost;
  }
  return warm ? DeviceState::warm : DeviceState::ready;
}

/// What a client adds to the bits of hand::ForceReason, for its device; never on the wire.
enum DeviceReason : std::uint32_t {
  kWarm = 1u << 16u,      ///< the motors have to be spared: lowered towards the continuous force
  kNotReady = 1u << 17u,  ///< the device is not ready, or lost: no force
};

/// One device. open() and close() are called on the main thread; read() and write() on the loop's thread, once a tick
/// and in this order. They must not block longer than the device's own transfer takes, and must not throw.
class Device {
 public:
  virtual ~Device() = default;
  /// Errors: not connected, no permission, in use by another program.
  [[nodiscard]] virtual Expected<void> open() = 0;
  /// After open(), once; the last force written was zero. Lets the device go, for other programs too.
  virtual void close() noexcept = 0;
  /// The hand now. `dt` is the time since the last call.
  [[nodiscard]] virtual client::HandSample read(Duration dt) noexcept = 0;
  /// The force to render until the next call. Zero before close().
  virtual void write(const hand::HandForce& force) noexcept = 0;
  /// After read(), on the same thread.
  [[nodiscard]] virtual DeviceCondition condition() const noexcept { return DeviceCondition::ready; }
  /// What the device can bear; the loop's governor is made from it.
  [[nodiscard]] virtual hand::GovernorConfig limits() const = 0;
  /// What it can bear all day; at most the largest force of limits().
  [[nodiscard]] virtual double continuous_force_n() const { return limits().max_force_n; }
  /// After open(). Whether it renders anything at all.
  [[nodiscard]] virtual bool renders() const { return true; }
};

}  // namespace mechane::haptic
