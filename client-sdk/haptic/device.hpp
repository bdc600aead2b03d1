// A haptic device as the loop sees it: gives the hand's position, takes the force to render.
#pragma once

#include "server/base/clock.hpp"
#include "server/hand/governor.hpp"
#include <mechane/client/types.hpp>

namespace mechane::haptic {

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
  /// What the device can bear; the loop's governor is made from it.
  [[nodiscard]] virtual hand::GovernorConfig limits() const = 0;
};

}  // namespace mechane::haptic
