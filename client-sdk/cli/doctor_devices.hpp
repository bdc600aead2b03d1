// Why a haptic device is not found or cannot be opened: drivers, makers' libraries, cables, rights, other programs. For `mechane doctor`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client-sdk/cli/device_access.hpp"
#include "server/realtime/machine_check.hpp"

namespace mechane::cli {

struct DeviceCheckOptions {
  std::filesystem::path root = "/";       ///< where dev, etc, proc and sys are; a test gives a folder of its own
  std::filesystem::path devices_program;  ///< mechane-devices, which lists the drivers: they are loaded in its process
  std::filesystem::path haptic_program;   ///< mechane-haptic, which judges the arguments that a kiosk's unit gives it
  Account account = this_account();       ///< judged for devices that no kiosk of this machine uses
};

/// Checks the devices that are set up for kiosks of this machine (etc/mechane/haptic-NAME), and those that are plugged in, without opening
/// them. Returns one result per problem, with its remedy: `bad` for a kiosk's device, `warning` for others. A device without problems gives
/// one `ok` result, and so does a machine without devices. The texts may hold bytes of files and programs that are not printable.
[[nodiscard]] std::vector<realtime::CheckResult> check_devices(const DeviceCheckOptions& options);

/// "1 haptic device will not start: see above", of what check_devices() returned. Empty where nothing in it is bad.
[[nodiscard]] std::string verdict_on(const std::vector<realtime::CheckResult>& devices);

}  // namespace mechane::cli
