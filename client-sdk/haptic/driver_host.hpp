// DriverHost: a driver in a process of its own, so that the device is given zero when the haptic loop dies.
#pragma once

#include <string>

#include "client-sdk/haptic/driver.hpp"
#include "client-sdk/haptic/driver_link.hpp"

namespace mechane::haptic {

/// Serves one device until the loop's process lets go, or is gone. The device renders nothing while its state does not say that it is
/// ready, and from 20 ms after the loop's last force on. A device that fails is closed, and opened again a second later.
class DriverHost {
 public:
  /// `news` is a SOCK_SEQPACKET socket to the loop's process.
  DriverHost(Driver driver, std::string options, SharedLink link, int news)
      : driver_(std::move(driver)), options_(std::move(options)), link_(std::move(link)), news_(news) {}

  /// Runs on the calling thread to the end. The exit status: 0, or 2 when the device could not be opened at the start, or another one
  /// took its place.
  [[nodiscard]] int run();

 private:
  /// Until the device fails (true) or the loop has gone (false); the last force is zero.
  [[nodiscard]] bool serve();
  [[nodiscard]] bool exchange(Duration period) noexcept;
  [[nodiscard]] bool loop_has_gone(int wait_ms = 0) const noexcept;
  void tell(HostNews::Kind kind, const std::string& text = {}) const noexcept;

  Driver driver_;
  std::string options_;
  SharedLink link_;
  int news_;
  mechane_device_info info_{};
  std::string why_;    // the device failed
  bool lost_ = false;  // and has given no state since
  Timed<mechane_device_force> newest_;
};

/// `mechane-devices --serve`: runs a host on the files that DriverProcess gave to this process.
[[nodiscard]] int serve_driver(const DeviceName& device, int fifo_priority);

}  // namespace mechane::haptic
