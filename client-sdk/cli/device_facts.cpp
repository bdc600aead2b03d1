#include "client-sdk/cli/device_facts.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
  constexpr const char* kSpace = " \t\r";
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) + 1 - begin);
}

/// NAME=VALUE, with or without quotes around the value.
Values values_of(const std::vector<std::string>& lines) {
  Values values;
  for (const std::string& line : lines) {
    const std::size_t equals = line.find('=');
    const std::string name = trimmed(line.substr(0, equals));
    if (equals == std::string::npos || name.starts_with('#') || name.starts_with(';')) continue;
    std::string value = trimmed(line.substr(equals + 1));
    if (value.size() >= 2 && (value.front() == '"' || value.front() == '\'') && value.back() == value.front())
      value = value.substr(1, value.size() - 2);
    values[name] = value;
  }
  return values;
}

/// What stands after an option of a command line, as in "--user 1" or "--user=1".
std::optional<std::string> option_of(const std::vector<std::string>& words, const std::string& option) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == option && i + 1 < words.size()) return words[i + 1];
    if (words[i].starts_with(option + "=")) return words[i].substr(option.size() + 1);
  }
  return std::nullopt;
}

/// Whether it is a serial line of a USB device: ttyUSB0, ttyACM1.
bool is_serial_line(const std::string& name) {
  return (name.starts_with("ttyUSB") || name.starts_with("ttyACM")) && is_number(name.substr(6));
}

/// The files in /dev that the kernel has made for a device: folders of these names, some levels down. Links lead elsewhere.
std::vector<std::string> lines_of(const fs::path& device) {
  std::set<std::string> lines;
  std::error_code unreadable;
  const fs::path real = fs::canonical(device, unreadable);
  for (fs::recursive_directory_iterator it(real, unreadable), end; !unreadable && it != end; it.increment(unreadable)) {
    const std::string name = it->path().filename().string();
    if (is_serial_line(name) || (name.starts_with("hidraw") && is_number(name.substr(6)))) lines.insert("/dev/" + name);
  }
  return {lines.begin(), lines.end()};
}

}  // namespace

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code unreadable;
  for (fs::directory_iterator it(folder, unreadable), end; !unreadable && it != end; it.increment(unreadable))
    found.push_back(it->path());
  std::ranges::sort(found);
  return found;
}

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string value_or(const Values& values, const std::string& name, std::string_view otherwise) {
  const auto found = values.find(name);
  return found == values.end() ? std::string(otherwise) : found->second;
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::istringstream list{std::string(text)};
  for (std::string part; std::getline(list, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

std::vector<KioskDevice> kiosk_devices(const fs::path& root) {
  constexpr std::string_view kPrefix = "haptic-";
  std::vector<KioskDevice> kiosks;
  for (const fs::path& file : entries_of(root / "etc/mechane")) {
    const std::string name = file.filename().string();
    if (!name.starts_with(kPrefix) || name.ends_with('~')) continue;  // ~: an editor's copy
    std::ifstream in(file);
    std::stringstream lines;
    lines << in.rdbuf();
    KioskDevice kiosk{name.substr(kPrefix.size()), "/etc/mechane/" + name, in.is_open(), {}, {}, {}};
    const Values values = values_of(split(lines.str(), '\n'));
    kiosk.text = value_or(values, "DEVICE", "");
    kiosk.kiosk = value_or(values, "KIOSK", kiosk.name);
    kiosk.arguments = split(value_or(values, "OPTIONS", ""), ' ');
    kiosk.user = option_of(kiosk.arguments, "--user").value_or(kiosk.user);
    kiosk.driver = kiosk.text.substr(0, kiosk.text.find(':'));
    if (kiosk.driver != kiosk.text) kiosk.options = values_of(split(kiosk.text.substr(kiosk.driver.size() + 1), ','));
    kiosks.push_back(kiosk);
  }
  return kiosks;
}

const std::vector<KnownUsbDevice>& known_usb_devices() {
  // As deploy/systemd/90-mechane-devices.rules has them, and as doubtful: the numbers are from public drivers, and none was tried on a
  // device; which of its two numbers is the Touch's vendor is not sure. The adapters are those of common ESP32 boards; no public page
  // says which board a glove has. Not here, for no number was found: Haply's arm, which its service owns, and the line of a CyberGlove,
  // which is any RS-232 adapter.
  static const std::vector<KnownUsbDevice> known{
      {"0403", "cb48", "Novint Falcon", "dhd"},
      {"1451", "", "Force Dimension device", "dhd"},
      {"2988", "", "3D Systems Touch", "openhaptics", true},
      {"0301", "2988", "3D Systems Touch", "openhaptics", true},
      {"10c4", "ea60", "serial adapter CP210x", "lucidgloves", true, true},
      {"1a86", "7523", "serial adapter CH340", "lucidgloves", true, true},
  };
  return known;
}

std::vector<PluggedDevice> plugged_usb(const fs::path& root) {
  std::vector<PluggedDevice> plugged;
  for (const fs::path& device : entries_of(root / "sys/bus/usb/devices")) {
    const std::string vendor = first_line(device / "idVendor");
    const std::string product = first_line(device / "idProduct");
    const auto known = std::ranges::find_if(known_usb_devices(), [&](const KnownUsbDevice& k) {
      return k.vendor == vendor && (k.product.empty() || k.product == product);
    });
    if (known == known_usb_devices().end()) continue;
    const auto node = [&] {
      return fmt::format("/dev/bus/usb/{:0>3}/{:0>3}", first_line(device / "busnum"), first_line(device / "devnum"));
    };
    plugged.push_back(
        {*known, fmt::format("USB {}:{}", vendor, product), known->is_line ? lines_of(device) : std::vector{node()}});
  }
  return plugged;
}

std::vector<PluggedDevice> plugged_firewire(const fs::path& root) {
  std::vector<PluggedDevice> plugged;
  for (const fs::path& device : entries_of(root / "sys/bus/firewire/devices")) {
    const std::string name = device.filename().string();  // fw1; fw1.0 is a part of it
    if (name.find('.') != std::string::npos || first_line(device / "is_local") == "1") continue;
    plugged.push_back({{"", "", "FireWire device", "openhaptics"}, "FireWire", {"/dev/" + name}});
  }
  return plugged;
}

std::vector<std::string> serial_lines(const fs::path& root) {
  std::vector<std::string> lines;
  for (const fs::path& file : entries_of(root / "dev"))
    if (is_serial_line(file.filename().string())) lines.push_back("/dev/" + file.filename().string());
  return lines;
}

std::string real_node(const fs::path& root, const std::string& node) {
  std::error_code missing;
  const fs::path real = fs::canonical(root / fs::path(node).relative_path(), missing);
  return missing ? "" : "/" + real.lexically_relative(fs::canonical(root, missing)).string();
}

bool is_listened_to(const fs::path& root, int port) {
  constexpr const char* kListening = "0A";  // "sl local_address rem_address st ...", in hexadecimal digits
  for (const char* table : {"proc/net/tcp", "proc/net/tcp6"}) {
    std::ifstream in(root / table);
    for (std::string line; std::getline(in, line);) {
      const auto words = split(line, ' ');
      if (words.size() > 3 && words[3] == kListening && words[1].ends_with(fmt::format(":{:04X}", port))) return true;
    }
  }
  return false;
}

std::string why_not_loaded(const std::vector<std::string>& files) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return "no pipe can be made; raise the limit of open files";
  const pid_t child = fork();
  if (child == 0) {
    alarm(10);
    std::string why;
    for (const std::string& file : files) {
      if (dlopen(file.c_str(), RTLD_LAZY | RTLD_GLOBAL) != nullptr) _exit(0);
      const std::string error = dlerror();
      // A file that is there and does not load tells more than one that is not there.
      if (why.empty() || !error.starts_with(file + ": cannot open")) why = error;
    }
    _exit(write(ends[1], why.data(), why.size()) < 0 ? 2 : 1);
  }
  close(ends[1]);
  std::string why;
  std::array<char, 1024> piece{};
  for (ssize_t n = 0; (n = read(ends[0], piece.data(), piece.size())) > 0;)
    why.append(piece.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return "no process can be started to try it";
  return WIFSIGNALED(status) ? "it crashes, or hangs, while it is loaded" : why;
}

}  // namespace mechane::cli
