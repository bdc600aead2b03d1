// DriverProcess: a real device, whose driver runs in a process of its own.
#pragma once

#include <atomic>
#include <optional>
#include <string>

#include <sys/types.h>

#include "client-sdk/haptic/device.hpp"
#include "client-sdk/haptic/driver.hpp"
#include "client-sdk/haptic/driver_link.hpp"
#include "client-sdk/haptic/hand_calibration.hpp"
#include "client-sdk/haptic/hand_speed.hpp"
#include "client-sdk/haptic/workspace.hpp"
#include "server/realtime/mailbox.hpp"

namespace mechane::haptic {

struct DriverProcessConfig {
  DeviceName device;
  WorkspaceConfig workspace = {};
  int fifo_priority = 0;                      ///< of the driver's process; above the loop's
  std::optional<HandCalibration> glove = {};  ///< none: its angles are taken as they come
  double hand_scale = 1;                      ///< of a visitor whose hand the device does not measure
};

/// open(), close(), check(), put() and the description: main thread. wait(), read(), write() and condition(): the loop's thread.
class DriverProcess final : public Device {
 public:
  explicit DriverProcess(DriverProcessConfig config) : config_(std::move(config)), workspace_(config_.workspace) {}
  ~DriverProcess() override { close(); }

  /// Starts the process and waits until it has opened the device, which may take seconds. Errors: no such driver, what
  /// the driver says, a process that cannot be started or that died.
  [[nodiscard]] Expected<void> open() override;
  /// Lets the process close the device, and ends it by force where that takes over 2 s.
  void close() noexcept override;

  /// Waits until the device has given a state that read() has not seen. False: none within `limit`.
  [[nodiscard]] bool wait(Duration limit) noexcept;
  /// The newest state. Its velocity is that of HandSpeed. Button 0 of a one-point
  /// device grasps. While the clutch is down, the device is not ready.
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override;
  void write(const hand::HandForce& force) noexcept override;
  [[nodiscard]] DeviceCondition condition() const noexcept override { return condition_; }
  /// What the driver told with the newest state.
  [[nodiscard]] const mechane_device_state& state() const noexcept { return newest_.value; }
  /// What one call of the driver's read() took, at most. After open(); any thread.
  [[nodiscard]] Duration longest_read() const noexcept { return (*link_)->longest_read; }

  /// What is new since the last call, in words: the device failed, is back, or has for a second been in another
  /// condition than was told. Error: its process died or hangs, or another device took its place; then it has to be
  /// opened anew.
  [[nodiscard]] Expected<std::optional<std::string>> check();

  /// Puts the workspace elsewhere: the hand is then somewhere else, and its speed is that of what comes after. The caller sees to it that
  /// no force is rendered meanwhile.
  void put(const client::DevicePlace& place) noexcept { places_.publish(place); }

  [[nodiscard]] hand::GovernorConfig limits() const override;
  [[nodiscard]] double continuous_force_n() const override { return info_.continuous_force_n; }
  [[nodiscard]] bool renders() const override { return info_.output != MECHANE_OUTPUT_NONE; }
  [[nodiscard]] const mechane_device_info& info() const noexcept { return info_; }

 private:
  [[nodiscard]] Expected<void> start();
  [[nodiscard]] std::optional<HostNews> next_news(int wait_ms) const;
  [[nodiscard]] std::string place() const;
  /// How the process ended, if it does within this time.
  [[nodiscard]] std::optional<Error> died(Duration within) const;
  [[nodiscard]] std::optional<std::string> changed_condition(TimePoint now);

  DriverProcessConfig config_;
  Workspace workspace_;
  realtime::Mailbox<client::DevicePlace> places_;
  bool clutched_ = false;
  std::optional<SharedLink> link_;
  pid_t process_ = -1;
  int news_ = -1;
  mechane_device_info info_{};
  Timed<mechane_device_state> newest_;
  bool came_ = false;  // newest_ came since the last read()
  std::atomic<DeviceCondition> condition_{DeviceCondition::lost};
  client::HandSample last_;
  TimePoint last_at_;
  HandSpeed speed_;
  std::atomic<TimePoint> newest_at_{TimePoint{}};  // of newest_, for check()
  bool told_lost_ = false;                         // by the process
  // check()'s: what was told last, what was seen last, and since when.
  client::DeviceState told_ = client::DeviceState::ready, seen_ = client::DeviceState::lost;
  TimePoint seen_since_;
};

}  // namespace mechane::haptic
