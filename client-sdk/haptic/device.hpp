// A haptic device as the loop sees it: gives the hand's position, takes the force to render.
#pragma once

#include "server/base/clock.hpp"
#include "server/hand/governor.hpp"
#include <mechane/client/types.hpp>

namespace mechane::haptic {

/// Whether a device may be given a force.
enum class DeviceCondition : std::uint8_t {
  ready,
  not_ready,  ///< it reads the hand, but is not calibrated, too warm, or not held: no force
  lost,       ///< gone or faulty: what read() gives is old
};

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
};

}  // namespace mechane::haptic
