#include "client-sdk/cli/doctor_devices.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "client-sdk/cli/device_access.hpp"
#include "client-sdk/cli/device_facts.hpp"
#include "server/content/child_process.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using realtime::CheckResult;
using realtime::CheckStatus;

/// What a driver of Mechane needs besides itself; as in its source.
struct DriverNeeds {
  std::string_view driver;
  std::vector<std::string> libraries;  ///< one of these, tried in this order
  std::string_view software;           ///< that brings the library
  std::string_view which;              ///< the option that tells one device of it from another
  std::string_view without;            ///< which one it is without that option
};

const DriverNeeds& needs_of(std::string_view driver) {
  static const std::vector<DriverNeeds> needs{
      {"openhaptics",
       {"libHD.so", "libHD.so.3.4", "libHD.so.3.0", "/usr/lib64/libHD.so"},
       "3D Systems' OpenHaptics and Touch driver",
       "name",
       "the default device"},
      {"dhd",
       {"libdrd.so.3", "libdrd.so", "/usr/local/lib/libdrd.so.3", "/usr/local/lib/libdrd.so"},
       "Force Dimension's SDK",
       "device",
       "0"},
      {"falcon", {}, "", "device", "0"},
      {"haply", {}, "", "device", "the first arm"},
      {"lucidgloves", {}, "", "port", "/dev/ttyUSB0"},
      {"cyberglove", {}, "", "port", "/dev/ttyUSB0"},
  };
  static const DriverNeeds none{};
  const auto found = std::ranges::find(needs, driver, &DriverNeeds::driver);
  return found == needs.end() ? none : *found;
}

/// The option `port`. It names a serial line only where it begins with '/': Haply's port is a number, and somebody else's driver may have
/// such an option, too.
std::string line_of(const KioskDevice& kiosk) {
  const DriverNeeds& needs = needs_of(kiosk.driver);
  return value_or(kiosk.options, "port", needs.which == "port" ? needs.without : "");
}

constexpr const char* kDeviceGroup = "mechane-devices";  // of the udev rules
constexpr const char* kSerialGroup = "dialout";          // Debian's, for serial lines
constexpr const char* kRules = "/etc/udev/rules.d/90-mechane-devices.rules";
constexpr const char* kInstallDrivers = "cmake --install build/release --component drivers --prefix /usr";
constexpr std::string_view kDeviceOf = "device of ";  // begins the name of each result about a kiosk's device
constexpr uid_t kNoUser = static_cast<uid_t>(-1);     // a unit's user is systemd's choice; its groups count

/// What is wrong with one device.
class Problems {
 public:
  void add(std::string found, std::string wanted, std::string remedy) {
    list_.push_back({{}, {}, std::move(found), std::move(wanted), std::move(remedy)});
  }
  /// A result for each problem; without one a result that says `fine`.
  void report(const std::string& name, CheckStatus status, const std::string& fine, std::vector<CheckResult>& results) {
    if (list_.empty()) results.push_back({name, CheckStatus::ok, fine, "a device that can be opened", ""});
    for (CheckResult& problem : list_) {
      problem.name = name;
      problem.status = status;
      results.push_back(std::move(problem));
    }
  }

 private:
  std::vector<CheckResult> list_;
};

class DeviceCheck {
 public:
  explicit DeviceCheck(const DeviceCheckOptions& options)
      : root_(options.root),
        haptic_program_(options.haptic_program),
        account_(options.account),
        open_files_(root_),
        kiosks_(kiosk_devices(root_)),
        plugged_(plugged_usb(root_)) {
    if (kiosk_with("openhaptics") != nullptr) std::ranges::move(plugged_firewire(root_), std::back_inserter(plugged_));
    list_drivers(options.devices_program);
  }
  std::vector<CheckResult> results();

 private:
  void list_drivers(const fs::path& program);
  [[nodiscard]] const KioskDevice* kiosk_with(std::string_view driver) const;
  [[nodiscard]] Account account_of(const KioskDevice& kiosk) const;
  [[nodiscard]] std::string device_of(const KioskDevice& kiosk) const;
  [[nodiscard]] fs::path at(const std::string& path) const { return root_ / fs::path(path).relative_path(); }

  void check_kiosk(const KioskDevice& kiosk);
  void check_arguments(const KioskDevice& kiosk, Problems& problems) const;
  void check_others(const KioskDevice& kiosk, Problems& problems) const;
  void check_plugged(const PluggedDevice& device);
  void check_adapter(const PluggedDevice& device);
  void check_driver(const std::string& name, const std::string& remedy, Problems& problems) const;
  void check_library(const std::string& driver, const Values& options, Problems& problems) const;
  void check_is_plugged(const KioskDevice& kiosk, Problems& problems) const;
  void check_haply(const Values& options, Problems& problems) const;
  void check_port(const KioskDevice& kiosk, const std::string& port, Problems& problems) const;
  void check_right(const std::string& node, const Account& who, const std::string& group, Problems& problems) const;
  void check_users(const std::string& node, Problems& problems) const;
  [[nodiscard]] std::string remedy_for_right(const std::string& node, const struct stat& status, const Account& who,
                                             const std::string& group) const;
  [[nodiscard]] std::string use_of(const std::string& node, const std::string& who) const;

  fs::path root_;
  fs::path haptic_program_;
  Account account_;
  OpenFiles open_files_;
  std::vector<KioskDevice> kiosks_;
  std::vector<PluggedDevice> plugged_;
  bool drivers_are_listed_ = false;
  Values drivers_;  // what is wrong with each; empty: it can be used
  std::vector<CheckResult> results_;
};

void DeviceCheck::list_drivers(const fs::path& program) {
  constexpr std::uint64_t kMostOutput = 1 << 20;
  const auto child = content::run_child(program, {"--json"}, std::chrono::seconds(20), kMostOutput);
  std::string fault;
  if (child) {
    const auto* text = reinterpret_cast<const char*>(child->output.data());
    const auto list = nlohmann::json::parse(text, text + child->output.size(), nullptr, false);
    drivers_are_listed_ = child->end == content::ChildResult::End::exited && list.is_array();
    if (drivers_are_listed_) {
      for (const auto& driver : list)
        drivers_[driver.value("name", "")] = driver.value("fault", "");
      return;
    }
    fault = program.string() + (child->end == content::ChildResult::End::timed_out ? " hangs" : " fails") +
            " while it loads the drivers";
  } else {
    // A machine without devices, such as a server, may lack it.
    if (kiosks_.empty() && std::ranges::all_of(plugged_, [](const auto& device) { return device.known.is_adapter; }))
      return;
    fault = child.error().what.empty() ? "" : program.string() + " " + child.error().what;
  }
  Problems problems;
  problems.add(fault, "a list of the drivers",
               child ? "run 'mechane devices'; if it fails too, take drivers that are not Mechane's out of their folder"
                     : "install all programs of Mechane into one folder");
  problems.report("drivers", kiosks_.empty() ? CheckStatus::warning : CheckStatus::bad, "", results_);
}

const KioskDevice* DeviceCheck::kiosk_with(std::string_view driver) const {
  const auto found = std::ranges::find(kiosks_, driver, &KioskDevice::driver);
  return found == kiosks_.end() ? nullptr : &*found;
}

/// As in mechane-haptic@.service: a user of its own, with these groups.
Account DeviceCheck::account_of(const KioskDevice& kiosk) const {
  Account account{"mechane-haptic@" + kiosk.name, kNoUser, {}};
  for (const char* group : {kSerialGroup, kDeviceGroup})
    if (const auto id = group_id(root_, group)) account.groups.push_back(*id);
  return account;
}

/// The same text for two kiosks' devices that are one; empty where that cannot be told.
std::string DeviceCheck::device_of(const KioskDevice& kiosk) const {
  const DriverNeeds& needs = needs_of(kiosk.driver);
  if (needs.which.empty()) return "";
  const std::string which = value_or(kiosk.options, std::string(needs.which), needs.without);
  const std::string node = which.starts_with('/') ? real_node(root_, which) : "";
  return node.empty() ? kiosk.driver + ": " + which : node;
}

void DeviceCheck::check_driver(const std::string& name, const std::string& remedy, Problems& problems) const {
  const std::string wanted = "a driver of this version of Mechane";
  if (name.find('/') != std::string::npos) {
    std::error_code unreadable;
    if (!fs::exists(at(name), unreadable))
      problems.add("the driver " + name + " is not installed", wanted, "install it" + remedy);
    return;
  }
  if (!drivers_are_listed_) return;
  const auto found = drivers_.find(name);
  if (found == drivers_.end()) {
    std::string names;
    for (const auto& [other, fault] : drivers_)
      names += (names.empty() ? "" : ", ") + other;
    problems.add(fmt::format("the driver '{}' is not installed; these are: {}", name, names), wanted,
                 kInstallDrivers + remedy);
  } else if (!found->second.empty()) {
    problems.add(found->second, wanted, fmt::format("install the drivers of this version: {}", kInstallDrivers));
  }
}

void DeviceCheck::check_library(const std::string& driver, const Values& options, Problems& problems) const {
  const DriverNeeds& needs = needs_of(driver);
  if (needs.libraries.empty()) return;
  std::vector<std::string> files = needs.libraries;
  if (options.contains("library")) files = {options.at("library")};
  std::string tried;
  for (std::string& file : files) {
    tried += (tried.empty() ? "" : ", ") + file;
    if (file.starts_with('/')) file = at(file).string();
  }
  const std::string why = why_not_loaded(files);
  if (why.empty()) return;
  const bool missing = why.starts_with(files.front() + ": cannot open") && why.ends_with("No such file or directory");
  problems.add(missing ? "the maker's library is not there; looked for: " + tried
                       : fmt::format("the maker's library does not load: {} (of: {})", why, tried),
               fmt::format("{}, which the driver {} needs", needs.software, driver),
               fmt::format("install it and run ldconfig; or name the library's file: {}:library=FILE", driver));
}

/// Of several devices of one driver, the first ones are taken to be those that are plugged in.
void DeviceCheck::check_is_plugged(const KioskDevice& kiosk, Problems& problems) const {
  const std::string& driver = kiosk.driver;
  const auto before = std::count_if(kiosks_.data(), &kiosk, [&](const KioskDevice& k) { return k.driver == driver; });
  const auto there = std::ranges::count(plugged_, driver, [](const PluggedDevice& d) { return d.known.driver; });
  if (there > before) return;
  std::string names;
  for (const KnownUsbDevice& k : known_usb_devices())
    if (k.driver == driver && !k.is_adapter)
      names +=
          fmt::format("{}{} ({}:{})", names.empty() ? "" : ", ", k.name, k.vendor, k.product.empty() ? "*" : k.product);
  if (names.empty()) return;
  problems.add(
      fmt::format("no device{} of the driver {} is plugged in and on; known by USB: {}",
                  there == 0 ? "" : fmt::format(" {}", before + 1), driver, names),
      "a device that is plugged in",
      fmt::format("check its power supply, its switch and its cable until lsusb lists it{}",
                  driver == "openhaptics" ? "; a device at Ethernet or the parallel port is not seen here: use "
                                            "the maker's test program"
                                          : ""));
}

/// Starts the program as the unit does; it reads its arguments and ends. A shell joins what it says of them, on standard error, to its
/// output.
void DeviceCheck::check_arguments(const KioskDevice& kiosk, Problems& problems) const {
  std::vector<std::string> words = {
      "-c",      "exec \"$0\" \"$@\" 2>&1", haptic_program_.string(), "--check", "--kiosk", kiosk.kiosk, "--device",
      kiosk.text};
  words.insert(words.end(), kiosk.arguments.begin(), kiosk.arguments.end());
  constexpr std::uint64_t kMostOutput = 1 << 16;
  const auto child = content::run_child("/bin/sh", words, std::chrono::seconds(20), kMostOutput);
  const bool ended = child && child->end == content::ChildResult::End::exited;
  if (ended && child->code == 0) return;
  constexpr int kWrongArguments = 2;
  const std::string wanted = "arguments that mechane-haptic takes";
  if (!ended || child->code != kWrongArguments)
    return problems.add(haptic_program_.string() + " does not run", wanted,
                        "install all programs of Mechane into one folder");
  const std::string said(reinterpret_cast<const char*>(child->output.data()), child->output.size());
  problems.add(said.substr(0, said.find('\n')), wanted,
               fmt::format("correct {}; 'mechane haptic --help' lists the options", kiosk.file));
}

/// A hand has one device, and a device one owner. Of two that clash, the later one is told of it.
void DeviceCheck::check_others(const KioskDevice& kiosk, Problems& problems) const {
  const std::string device = device_of(kiosk);
  for (const KioskDevice* other = kiosks_.data(); other != &kiosk; ++other) {
    if (other->kiosk == kiosk.kiosk && other->user == kiosk.user)
      problems.add(fmt::format("hand {} of {} has the device of {} already", kiosk.user, kiosk.kiosk, other->file),
                   "a hand of its own for each device of a kiosk",
                   fmt::format("add another hand to OPTIONS= in {}: --user 1, 2 or 3", kiosk.file));
    if (!device.empty() && device_of(*other) == device)
      problems.add(fmt::format("it is one and the same as the device of {} ({})", other->file, device),
                   "one owner for each device",
                   fmt::format("name another one in {}: DEVICE={}:{}=...", kiosk.file, kiosk.driver,
                               needs_of(kiosk.driver).which));
  }
}

/// The arm belongs to Haply's own service, which knows of its cable.
void DeviceCheck::check_haply(const Values& options, Problems& problems) const {
  const std::string host = value_or(options, "host", "127.0.0.1");
  const int port = std::atoi(value_or(options, "port", "10001").c_str());
  if ((host != "127.0.0.1" && host != "localhost") || is_listened_to(root_, port)) return;
  problems.add(
      fmt::format("Haply's service does not run: nothing listens at port {}", port),
      "Haply's own service, which owns the arm",
      "install Haply's software; systemctl enable --now haply-inverse-service; then check the arm's power and cable");
}

void DeviceCheck::check_port(const KioskDevice& kiosk, const std::string& port, Problems& problems) const {
  if (!real_node(root_, port).empty()) {
    check_right(port, account_of(kiosk), kSerialGroup, problems);
    check_users(port, problems);
    return;
  }
  std::string others;
  for (const std::string& line : serial_lines(root_))
    others += (others.empty() ? "" : ", ") + line;
  const std::string check = "check the cable and the device's power; 'journalctl -k' shows what was plugged in";
  if (others.empty())
    problems.add(port + " is not there, nor any other serial line by USB", "the device's serial line", check);
  else
    problems.add(
        port + " is not there; serial lines by USB: " + others, "the device's serial line",
        fmt::format("{}; if the device is at another line, name that as port= in {}, best as in /dev/serial/by-id",
                    check, kiosk.file));
}

void DeviceCheck::check_right(const std::string& node, const Account& who, const std::string& group,
                              Problems& problems) const {
  const std::string real = real_node(root_, node);
  struct stat status {};
  if (real.empty() || stat(at(real).c_str(), &status) != 0) {
    problems.add(node + " is not there, although the device is plugged in", "the device's file in /dev",
                 "udevadm trigger; in a container: give it the device");
  } else if (!may_open(who, at(real), status)) {
    problems.add(fmt::format("{} may not open {}: owner {}, group {}, mode {:04o}", who.name, node,
                             name_of_id(at("/etc/passwd"), status.st_uid), name_of_id(at("/etc/group"), status.st_gid),
                             status.st_mode & 07777U),
                 "the right to read and write, by the group " + group, remedy_for_right(real, status, who, group));
  }
}

std::string DeviceCheck::remedy_for_right(const std::string& node, const struct stat& status, const Account& who,
                                          const std::string& group) const {
  std::vector<std::string> steps;
  const auto id = group_id(root_, group);
  if (!id) steps.push_back("groupadd --system " + group);
  const bool group_may =
      id && status.st_gid == *id && (status.st_mode & S_IRGRP) != 0 && (status.st_mode & S_IWGRP) != 0;
  if (!group_may && group == kDeviceGroup) {
    std::error_code unreadable;
    if (!fs::exists(at(kRules), unreadable))
      steps.push_back(fmt::format("copy deploy/systemd/90-mechane-devices.rules to {}", kRules));
    steps.emplace_back("udevadm control --reload && udevadm trigger");
  } else if (!group_may) {
    steps.push_back(fmt::format(
        "chgrp {0} {1} && chmod g+rw {1} (lasts until it is unplugged; a udev rule makes it last)", group, node));
  }
  if (who.user != kNoUser && (!id || std::ranges::count(who.groups, *id) == 0))
    steps.push_back(fmt::format("usermod -aG {} {}, and log in again", group, who.name));
  if (steps.empty()) steps.push_back("chmod ug+rw " + node);
  std::string remedy = "as root: ";
  for (const std::string& step : steps)
    remedy += (&step == &steps.front() ? "" : "; then ") + step;
  return remedy;
}

void DeviceCheck::check_users(const std::string& node, Problems& problems) const {
  for (const auto& [process, name] : open_files_.users_of(real_node(root_, node)))
    if (!name.starts_with("mechane-"))
      problems.add(fmt::format("{} (process {}) has {} open", name, process, node), "no other program at the device",
                   fmt::format("end {}; 'systemctl status {}' tells whether a service starts it again", name, process));
}

/// For a node without a problem.
std::string DeviceCheck::use_of(const std::string& node, const std::string& who) const {
  const Values users = open_files_.users_of(real_node(root_, node));
  if (!users.empty())
    return fmt::format("{}, used by {} (process {})", node, users.begin()->second, users.begin()->first);
  return fmt::format("{}, which {} may open{}", node, who,
                     open_files_.all_seen() ? "" : " (only root sees whether another program has it open)");
}

void DeviceCheck::check_kiosk(const KioskDevice& kiosk) {
  const std::string name = std::string(kDeviceOf) + kiosk.name;
  Problems problems;
  if (!kiosk.readable) {
    problems.add(kiosk.file + " cannot be read", "the name of the kiosk's device", "run mechane doctor as root");
    return problems.report(name, CheckStatus::warning, "", results_);
  }
  if (kiosk.text.empty()) {
    problems.add(kiosk.file + " names no device", "a line such as DEVICE=haply",
                 "add it; 'mechane devices' lists the drivers and their options");
    return problems.report(name, CheckStatus::bad, "", results_);
  }
  if (!group_id(root_, kDeviceGroup))
    problems.add(fmt::format("the group {} is missing, so the kiosk's unit does not start", kDeviceGroup),
                 "the group that owns haptic devices", fmt::format("as root: groupadd --system {}", kDeviceGroup));
  check_driver(kiosk.driver, "; or correct DEVICE= in " + kiosk.file, problems);
  check_library(kiosk.driver, kiosk.options, problems);
  check_is_plugged(kiosk, problems);
  check_arguments(kiosk, problems);
  check_others(kiosk, problems);
  if (kiosk.driver == "haply") check_haply(kiosk.options, problems);
  const std::string port = line_of(kiosk);
  const bool has_line = port.starts_with('/');
  if (has_line) check_port(kiosk, port, problems);
  problems.report(name, CheckStatus::bad,
                  fmt::format("{}, hand {} of {}{}", has_line ? kiosk.driver : kiosk.text, kiosk.user, kiosk.kiosk,
                              has_line ? ", at " + use_of(port, account_of(kiosk).name) : ""),
                  results_);
}

void DeviceCheck::check_plugged(const PluggedDevice& device) {
  const std::string driver(device.known.driver);
  const KioskDevice* const kiosk = kiosk_with(driver);
  const Account who = kiosk == nullptr ? account_ : account_of(*kiosk);
  Problems problems;
  std::string fine = device.where;
  if (device.nodes.empty())
    problems.add(device.where + " is plugged in, but Linux has made no file in /dev for it",
                 "/dev/ttyACM* or /dev/hidraw*", "plug it in again; 'journalctl -k' shows why");
  for (const std::string& node : device.nodes) {
    check_right(node, who, kDeviceGroup, problems);
    check_users(node, problems);
    fine += "; " + use_of(node, who.name);
  }
  if (kiosk == nullptr) {
    check_driver(driver, "", problems);
    check_library(driver, {}, problems);
  }
  problems.report(std::string(device.known.name), kiosk == nullptr ? CheckStatus::warning : CheckStatus::bad, fine,
                  results_);
}

/// The adapter of a glove, or of something else. Where another program has it open, it is taken to be that program's.
void DeviceCheck::check_adapter(const PluggedDevice& device) {
  Problems problems;
  std::string fine = device.where + ", perhaps of a LucidGloves board";
  if (device.nodes.empty())
    problems.add(device.where + " is plugged in, but Linux has made no serial line for it",
                 "/dev/ttyUSB* or /dev/ttyACM*",
                 "plug it in again; 'journalctl -k' shows why. brltty, for Braille displays, may have taken it: "
                 "apt remove brltty");
  for (const std::string& node : device.nodes) {
    fine += "; " + use_of(node, account_.name);
    if (open_files_.users_of(node).empty()) check_right(node, account_, kSerialGroup, problems);
  }
  problems.report(std::string(device.known.name), CheckStatus::warning, fine, results_);
}

std::vector<CheckResult> DeviceCheck::results() {
  std::set<std::string> lines;  // of kiosks, which tell about them
  for (const KioskDevice& kiosk : kiosks_) {
    check_kiosk(kiosk);
    lines.insert(real_node(root_, line_of(kiosk)));
  }
  for (const PluggedDevice& device : plugged_) {
    if (!device.known.is_adapter)
      check_plugged(device);
    else if (std::ranges::none_of(device.nodes, [&](const std::string& node) { return lines.contains(node); }))
      check_adapter(device);
  }
  for (const auto& [name, fault] : drivers_) {
    if (fault.empty() || kiosk_with(name) != nullptr) continue;
    Problems problems;
    check_driver(name, "", problems);
    problems.report("driver " + name, CheckStatus::warning, "", results_);
  }
  if (results_.empty())
    Problems().report(
        "haptic devices", CheckStatus::ok,
        "no kiosk has one (/etc/mechane/haptic-NAME), and no device that Mechane knows is connected and switched on",
        results_);
  return std::move(results_);
}

}  // namespace

std::vector<CheckResult> check_devices(const DeviceCheckOptions& options) {
  return DeviceCheck(options).results();
}

std::string verdict_on(const std::vector<CheckResult>& devices) {
  std::set<std::string> kiosks, others;  // others: what kiosks' devices need, such as a right or the drivers
  for (const CheckResult& r : devices)
    if (r.status == CheckStatus::bad) (r.name.starts_with(kDeviceOf) ? kiosks : others).insert(r.name);
  const std::size_t count = kiosks.empty() ? others.size() : kiosks.size();
  return count == 0 ? "" : fmt::format("{} haptic device{} will not start: see above", count, count == 1 ? "" : "s");
}

}  // namespace mechane::cli
