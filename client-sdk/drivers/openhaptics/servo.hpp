// What runs on the thread of the HD library's scheduler, and its exchange with the driver's thread.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <span>

#include "client-sdk/drivers/openhaptics/api.hpp"
#include "client-sdk/drivers/openhaptics/mailbox.hpp"
#include <mechane/driver.h>

namespace mechane::drivers::hd {

using Clock = std::chrono::steady_clock;

/// What the device has and wants; does not change while it is open.
struct Traits {
  Style style = kAuto;
  bool gimbal = false;       // its transform holds an orientation
  bool torque = false;       // it takes a torque
  bool temperature = false;  // it knows its motors' temperature
  unsigned int ticks_a_second = 1000;
};

/// One tick of the device, in the library's units.
struct Sample {
  std::array<double, 3> position_mm{};
  std::array<double, 16> transform{};    // by columns, mm
  std::array<double, 6> temperatures{};  // below 0: not known
  int buttons = 0;
  bool calibrated = false;
  bool docked = false;  // the stylus lies in its inkwell
  bool ready = false;
  bool hot = false;
  ErrorInfo lost{};  // code other than 0: the device is lost and no tick follows
};

/// What to render, in the library's units.
struct Force {
  std::array<double, 3> force_n{};
  std::array<double, 3> torque_mnm{};
  Clock::time_point asked{};
  bool last = false;  // render this, then end
};

/// Whether the motors must rest: from a temperature over 0.7, or a warning of the library's, until it is under 0.5 and
/// the last warning is 10 s old. A temperature below 0 is not known.
class Heat {
 public:
  bool update(double temperature, bool warned, Clock::time_point now) noexcept;
  [[nodiscard]] bool hot() const noexcept { return hot_; }

 private:
  bool hot_ = false;
  Clock::time_point rest_until_{};
};

/// The warmest of those that are known; -1 when none is.
[[nodiscard]] double warmest(std::span<const double> temperatures) noexcept;

/// Converts a sample to SI, with the origin at `centre_mm` of the library's frame. False when the sample holds numbers
/// that no such device can have: not finite, further than 2 m away, or a matrix that is not a rotation.
[[nodiscard]] bool convert(const Sample& sample, const Traits& traits, std::span<const double, 3> centre_mm,
                           mechane_device_state& state) noexcept;

/// The callback of the scheduler. Made and destroyed while the scheduler does not run.
class Servo {
 public:
  Servo(const Api& api, Handle device, const Traits& traits);
  ~Servo();
  Servo(const Servo&) = delete;
  Servo& operator=(const Servo&) = delete;

  /// For hdScheduleAsynchronous, with the servo as its argument. Does not wait or allocate.
  static unsigned int callback(void* servo) noexcept { return static_cast<Servo*>(servo)->tick(); }

  // The driver's thread:
  /// The newest tick that it has not seen; waits for one. False: none came before `deadline`.
  [[nodiscard]] bool next(Sample& into, Clock::time_point deadline) noexcept;
  /// From the next tick on, until a newer force comes or this one is 20 ms old.
  void render(const Force& force) noexcept { forces_.put(force); }
  /// Whether the callback has run for the last time; waits for that.
  [[nodiscard]] bool ended(Clock::time_point deadline) noexcept;

 private:
  unsigned int tick() noexcept;
  void calibrate() noexcept;
  void get(Sample& sample) noexcept;
  void set(bool allowed) noexcept;
  void wait_for_tick(Clock::time_point deadline) const noexcept;

  const Api api_;
  const Handle device_;
  const Traits traits_;
  const int bell_;  // an eventfd, rung at the end of each tick
  NewestValue<Sample> samples_;
  NewestValue<Force> forces_;
  std::atomic<bool> ended_{false};

  // The scheduler's thread alone:
  Heat heat_;
  Force force_;
  unsigned int ticks_ = 0;
  bool calibrated_ = false;
  bool pushing_ = false;       // the last tick rendered a force
  bool was_undocked_ = false;  // the inkwell's switch has been seen open: it works
};

}  // namespace mechane::drivers::hd
