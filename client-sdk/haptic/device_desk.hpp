// DeviceDesk: tells staff of an open device, and does what they ask for while its loop runs.
#pragma once

#include "client-sdk/haptic/device_thread.hpp"
#include "client-sdk/haptic/driver_process.hpp"
#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/loop_turns.hpp"
#include <mechane/client/client.hpp>

namespace mechane::haptic {

/// The main thread. It ends before what it was given.
class DeviceDesk {
 public:
  static constexpr Duration kTestLasts = std::chrono::seconds(20);

  /// `told` outlives the loop: it keeps the place and the last answer while the device is opened anew.
  DeviceDesk(client::Client& client, DriverProcess& device, HapticLoop& loop, LoopTurns& turns,
             const DeviceThread& thread, client::DeviceDetails& told, TimePoint now);

  /// Call it five times a second.
  void look(TimePoint now);
  /// Whether staff have asked for the glove to be fitted to a hand.
  [[nodiscard]] bool fits() const { return fits_; }
  /// For visitors: in a test, what the loop cannot see.
  [[nodiscard]] client::DeviceState state() const;

 private:
  void take(const client::DeviceRequest& request, TimePoint now);
  /// What is done at once, or why it is not.
  [[nodiscard]] Expected<void> act(const client::DeviceRequest& request, TimePoint now);
  [[nodiscard]] Expected<void> put(const client::DevicePlace& place);
  [[nodiscard]] Expected<void> start_test(TimePoint now);
  /// Where the force does not go to zero, the loop goes on.
  [[nodiscard]] Expected<void> pause(const char* place);
  void end_test();
  void note(TimePoint now);

  client::Client& client_;
  DriverProcess& device_;
  HapticLoop& loop_;
  LoopTurns& turns_;
  DevicePace pace_;
  client::DeviceDetails& told_;
  TimePoint next_;
  TimePoint test_ends_;
  bool fits_ = false;
};

/// For a simulated device, which stays as it was started: refuses requests, and tells of it once a second, at `next`.
void turn_down(client::Client& client, LoopTurns& turns, client::DeviceDetails& told, TimePoint now, TimePoint& next);

}  // namespace mechane::haptic
