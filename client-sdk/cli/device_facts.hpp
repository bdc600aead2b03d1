// What a machine shows of haptic devices without opening one: kiosks' settings, what is plugged in, makers' libraries.
// `root` is where dev, etc, proc and sys are; paths that are told and asked for begin with "/", as if root were "/".
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace mechane::cli {

/// Empty where the file cannot be read.
[[nodiscard]] std::string first_line(const std::filesystem::path& file);
/// Sorted, so that reports are the same each time. None for a folder that cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
[[nodiscard]] bool is_number(std::string_view text);

using Values = std::map<std::string, std::string>;
[[nodiscard]] std::string value_or(const Values& values, const std::string& name, std::string_view otherwise);
/// Without empty parts.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

/// A device that a kiosk is to have: etc/mechane/haptic-NAME, which mechane-haptic@.service reads.
struct KioskDevice {
  std::string name;  ///< of the unit's instance: "kiosk-1", or "kiosk-1-left" for a second device
  std::string file;  ///< "/etc/mechane/haptic-kiosk-1"
  bool readable = false;
  std::string text;  ///< "lucidgloves:port=/dev/ttyUSB0"
  std::string driver;
  Values options;
  std::string kiosk{};                   ///< KIOSK=, or else the name
  std::string user = "0";                ///< which hand of the kiosk
  std::vector<std::string> arguments{};  ///< OPTIONS=, word by word
};
[[nodiscard]] std::vector<KioskDevice> kiosk_devices(const std::filesystem::path& root);

/// A device that is known by its USB numbers, or an adapter behind which there may be one.
struct KnownUsbDevice {
  std::string_view vendor;   ///< "0403", as sysfs writes it
  std::string_view product;  ///< empty: all of the vendor
  std::string_view name;
  std::string_view driver;
  bool is_line = false;     ///< opened as /dev/ttyUSB*, ttyACM* or hidraw*, else as /dev/bus/usb/BUS/DEVICE
  bool is_adapter = false;  ///< other things than haptic devices have it too
};
[[nodiscard]] const std::vector<KnownUsbDevice>& known_usb_devices();

struct PluggedDevice {
  KnownUsbDevice known;
  std::string where;               ///< "USB 0403:cb48"
  std::vector<std::string> nodes;  ///< "/dev/bus/usb/001/004"
};
[[nodiscard]] std::vector<PluggedDevice> plugged_usb(const std::filesystem::path& root);
/// The bus does not tell which device is an Omni: all count, but this machine's own adapter.
[[nodiscard]] std::vector<PluggedDevice> plugged_firewire(const std::filesystem::path& root);
/// "/dev/ttyUSB0": all that are there.
[[nodiscard]] std::vector<std::string> serial_lines(const std::filesystem::path& root);
/// Links such as those in /dev/serial/by-id lead to it. Empty: it is not there.
[[nodiscard]] std::string real_node(const std::filesystem::path& root, const std::string& node);

/// Whether a program of this machine listens at a TCP port.
[[nodiscard]] bool is_listened_to(const std::filesystem::path& root, int port);

/// Tries to load one of the libraries, in a child process, because a maker's library may crash or hang. Empty when one loads; else the
/// reason why none does.
[[nodiscard]] std::string why_not_loaded(const std::vector<std::string>& files);

}  // namespace mechane::cli
