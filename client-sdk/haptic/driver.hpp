// Drivers of devices: shared objects behind the C interface of mechane/driver.h.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "server/base/error.hpp"
#include <mechane/driver.h>

namespace mechane::haptic {

/// "falcon:serial=4711": a driver by name, or a file's path with a slash in it, and the options for it.
struct DeviceName {
  std::string driver;
  std::string options;
};
[[nodiscard]] DeviceName parse_device_name(const std::string& text);

/// The folders in which drivers are looked for, in this order: those of MECHANE_DRIVERS (separated by colons), lib/mechane/drivers
/// beside the folder of the program, /usr/local/lib/mechane/drivers, /usr/lib/mechane/drivers.
[[nodiscard]] std::vector<std::string> driver_folders();

/// A driver that was loaded, and its device while that is open. A driver is not trusted with numbers: a device whose limits or states
/// are out of their ranges counts as faulty, and no force over its limits is handed to it. One thread.
class Driver {
 public:
  /// Errors: no such driver (with the places looked at), it does not load, not a driver, of a later version.
  [[nodiscard]] static Expected<Driver> load(const std::string& name);
  ~Driver() { close(); }
  Driver(Driver&&) noexcept;
  Driver& operator=(Driver&&) = delete;

  [[nodiscard]] const std::string& file() const noexcept { return file_; }
  [[nodiscard]] std::string summary() const { return driver_->summary; }
  [[nodiscard]] std::string options() const { return driver_->options; }

  /// Errors: what the driver says; limits out of the ranges of mechane_device_info.
  [[nodiscard]] Expected<mechane_device_info> open(const std::string& options);
  /// False: the device is gone or faulty, see why().
  [[nodiscard]] bool read(mechane_device_state& state) noexcept;
  /// Within the device's limits, whatever is asked for. False: see why().
  [[nodiscard]] bool write(mechane_device_force force) noexcept;
  void close() noexcept;
  /// Of the last call that failed.
  [[nodiscard]] std::string why() const { return why_[0] == 0 ? "the driver gives no reason" : why_.data(); }

 private:
  struct Unload {
    void operator()(void* library) const noexcept;
  };
  Driver(std::string file, std::unique_ptr<void, Unload> library, const mechane_driver_table& driver)
      : file_(std::move(file)), module_(std::move(library)), driver_(&driver) {}

  std::string file_;
  std::unique_ptr<void, Unload> module_;
  const mechane_driver_table* driver_;
  void* device_ = nullptr;
  mechane_device_info info_{};
  std::array<char, 512> why_{};
};

struct FoundDriver {
  std::string name;
  std::string file;
  std::string summary;
  std::string options;
  std::string fault;  ///< why it cannot be used; empty: it can
};
/// All drivers in driver_folders(), by name; where two folders have the same, the first counts.
[[nodiscard]] std::vector<FoundDriver> find_drivers();

}  // namespace mechane::haptic
