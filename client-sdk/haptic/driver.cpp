#include "client-sdk/haptic/driver.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include <dlfcn.h>

#include "server/base/program_folder.hpp"

namespace mechane::haptic {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "mechane_driver_";
constexpr std::string_view kSuffix = ".so";
constexpr std::uint32_t kFirstVersion = 1;  // its structures are the beginnings of today's
// A brake knows only on and off: any force over 0 closes it.
constexpr double kBrakeForceN = 1;

Expected<std::string> find_driver(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  std::string places;
  for (const std::string& folder : driver_folders()) {
    const fs::path path = fs::path(folder) / (std::string(kPrefix) + name + std::string(kSuffix));
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path.string();
    places += (places.empty() ? "" : ", ") + folder;
  }
  return fail(ErrorCode::not_found, "there is no driver of this name in " + places, "device '" + name + "'",
              "'mechane devices' lists the drivers; MECHANE_DRIVERS names further folders");
}

bool within(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// The first number that is out of its range, as in "rate_hz is 0, and not 50 to 8000"; empty: none.
std::string out_of_range(const mechane_device_info& info) {
  struct Range {
    const char* name;
    double value, least, most;
  };
  for (const Range& r :
       {Range{"hand", double(info.hand), 0, MECHANE_HAND_GLOVE},
        Range{"output", double(info.output), 0, MECHANE_OUTPUT_FINGER_BRAKE},
        Range{"side", double(info.side), 0, MECHANE_HAND_LEFT}, Range{"peak_force_n", info.peak_force_n, 0, 100},
        Range{"continuous_force_n", info.continuous_force_n, 0, info.peak_force_n},
        Range{"peak_torque_nm", info.peak_torque_nm, 0, 10},
        Range{"peak_finger_force_n", info.peak_finger_force_n, 0, 40},
        Range{"max_stiffness_n_per_m", info.max_stiffness_n_per_m, 0, 1e6},
        Range{"max_damping_ns_per_m", info.max_damping_ns_per_m, 0, 1e4}, Range{"rate_hz", info.rate_hz, 50, 8000}}) {
    if (within(r.value, r.least, r.most)) continue;
    std::ostringstream text;
    text << r.name << " is " << r.value << ", and not " << r.least << " to " << r.most;
    return text.str();
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (!within(info.workspace_min_m[i], -10, info.workspace_max_m[i]) || !(info.workspace_max_m[i] <= 10))
      return "workspace_min_m and workspace_max_m are not corners of a box within 10 m";
  return {};
}

/// Limits of kinds of force that the device does not render become zero.
void keep_to_output(mechane_device_info& info) {
  if (info.output != MECHANE_OUTPUT_FORCE) info.peak_force_n = info.continuous_force_n = info.peak_torque_nm = 0;
  if (info.output == MECHANE_OUTPUT_FINGER_BRAKE)
    info.peak_finger_force_n = kBrakeForceN;
  else if (info.output != MECHANE_OUTPUT_FINGER_PULL)
    info.peak_finger_force_n = 0;
  info.name[sizeof(info.name) - 1] = 0;
}

/// Whether all numbers of a state can be. Otherwise `why` says which one cannot. The driver's loop calls it: no allocation.
bool is_sane(const mechane_device_state& state, std::span<char> why) noexcept {
  constexpr double kMost = std::numeric_limits<double>::max();
  struct Range {
    const char* name;
    std::span<const double> values;
    double least, most;
    bool may_be_0 = false;
  };
  const Range ranges[] = {{"position_m", state.position_m, -kMost, kMost},
                          {"orientation_wxyz", state.orientation_wxyz, -kMost, kMost},
                          {"joints_rad", state.joints_rad, -kMost, kMost},
                          {"grasp", {&state.grasp, 1}, 0, 1},
                          {"temperature", {&state.temperature, 1}, -kMost, kMost},
                          {"palm_m", {&state.palm_m, 1}, 0.02, 0.25, true},
                          {"finger_m", state.finger_m, 0.005, 0.5, true}};
  for (const Range& r : ranges) {
    const auto wrong = std::ranges::find_if(
        r.values, [&](double value) { return !within(value, r.least, r.most) && !(r.may_be_0 && value == 0); });
    if (wrong == r.values.end()) continue;
    std::array<char, 8> index{};
    if (r.values.size() > 1) std::snprintf(index.data(), index.size(), "[%d]", int(wrong - r.values.begin()));
    std::array<char, 48> range{};
    if (std::isfinite(*wrong)) std::snprintf(range.data(), range.size(), ", and not %g to %g", r.least, r.most);
    std::snprintf(why.data(), why.size(), "read() gave %s%s = %g%s", r.name, index.data(), *wrong, range.data());
    return false;
  }
  const auto& q = state.orientation_wxyz;
  const double length = std::hypot(std::hypot(q[0], q[1], q[2]), q[3]);
  if (within(length, 0.995, 1.005)) return true;
  std::snprintf(why.data(), why.size(), "read() gave orientation_wxyz of length %g, and not 1", length);
  return false;
}

void clamp_norm(double (&v)[3], double limit) {
  if (!all_finite(v)) {
    std::ranges::fill(v, 0.0);
    return;
  }
  const double norm = std::hypot(v[0], v[1], v[2]);  // GCC 12's gives 0 where the largest is not a number
  if (!(norm > limit)) return;
  for (double& value : v)
    value *= limit / norm;
}

}  // namespace

DeviceName parse_device_name(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

std::vector<std::string> driver_folders() {
  std::vector<std::string> folders;
  if (const char* named = std::getenv("MECHANE_DRIVERS")) {
    std::istringstream list(named);
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.push_back(folder);
  }
  folders.push_back((program_folder().parent_path() / "lib/mechane/drivers").string());
  for (const char* folder : {"/usr/local/lib/mechane/drivers", "/usr/lib/mechane/drivers"})
    if (folder != folders.back()) folders.emplace_back(folder);
  return folders;
}

void Driver::Unload::operator()(void* library) const noexcept {
  ::dlclose(library);
}

Driver::Driver(Driver&& other) noexcept
    : file_(std::move(other.file_)),
      module_(std::move(other.module_)),
      driver_(other.driver_),
      device_(std::exchange(other.device_, nullptr)),
      info_(other.info_),
      why_(other.why_) {}

Expected<Driver> Driver::load(const std::string& name) {
  auto file = find_driver(name);
  if (!file) return tl::unexpected(file.error());
  std::unique_ptr<void, Unload> library(::dlopen(file->c_str(), RTLD_NOW | RTLD_LOCAL));
  if (library == nullptr) {
    return fail(ErrorCode::damaged, std::string("it does not load: ") + ::dlerror(), *file,
                "is it a driver for this machine? If libraries are missing, install them (ldd names them)");
  }
  const auto entry = reinterpret_cast<decltype(&mechane_driver)>(::dlsym(library.get(), "mechane_driver"));
  if (entry == nullptr)
    return fail(ErrorCode::damaged, "it is not a driver: it exports no mechane_driver()", *file,
                "see mechane/driver.h");
  const mechane_driver_table* table = entry(MECHANE_DRIVER_VERSION);
  if (table == nullptr) table = entry(kFirstVersion);
  if (table == nullptr || table->version < kFirstVersion || table->version > MECHANE_DRIVER_VERSION) {
    return fail(ErrorCode::wrong_version, "the driver is for another version of Mechane", *file,
                "build it with the mechane/driver.h of this version");
  }
  if (table->summary == nullptr || table->options == nullptr || table->open == nullptr || table->describe == nullptr ||
      table->read == nullptr || table->write == nullptr || table->close == nullptr)
    return fail(ErrorCode::damaged, "the driver's table is not filled in", *file, "see mechane/driver.h");
  return Driver(*file, std::move(library), *table);
}

Expected<mechane_device_info> Driver::open(const std::string& options) {
  why_.fill(0);
  info_ = {};
  device_ = nullptr;
  if (driver_->open(options.c_str(), &device_, why_.data(), why_.size() - 1) != 0) {
    device_ = nullptr;
    return fail(ErrorCode::io_failure, why(), "device");
  }
  if (device_ == nullptr)
    return fail(ErrorCode::damaged, "open() returned 0 but left *device NULL", file_, "see mechane/driver.h");
  if (driver_->describe(device_, &info_, why_.data(), why_.size() - 1) != 0) {
    close();
    return fail(ErrorCode::io_failure, why(), "device");
  }
  if (driver_->version == kFirstVersion) info_.side = MECHANE_HAND_RIGHT;  // padding, of which it knows nothing
  if (const std::string wrong = out_of_range(info_); !wrong.empty()) {
    close();
    return fail(ErrorCode::invalid_value, "the driver states limits that cannot be: " + wrong, file_,
                "see mechane_device_info in mechane/driver.h");
  }
  keep_to_output(info_);
  return info_;
}

bool Driver::read(mechane_device_state& state) noexcept {
  state = {};
  why_[0] = 0;
  return driver_->read(device_, &state, why_.data(), why_.size() - 1) == 0 && is_sane(state, why_);
}

bool Driver::write(mechane_device_force force) noexcept {
  clamp_norm(force.force_n, info_.peak_force_n);
  clamp_norm(force.torque_nm, info_.peak_torque_nm);
  for (double& finger : force.finger_n)
    finger = std::isfinite(finger) ? std::clamp(finger, 0.0, info_.peak_finger_force_n) : 0;
  why_[0] = 0;
  return driver_->write(device_, &force, why_.data(), why_.size() - 1) == 0;
}

void Driver::close() noexcept {
  if (device_ != nullptr) driver_->close(std::exchange(device_, nullptr));
}

std::vector<FoundDriver> find_drivers() {
  std::map<std::string, FoundDriver> found;
  for (const std::string& folder : driver_folders()) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, unreadable)) {
      const std::string file = entry.path().filename().string();
      if (!file.starts_with(kPrefix) || !file.ends_with(kSuffix)) continue;
      const std::string name = file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size());
      if (found.contains(name)) continue;
      const auto driver = Driver::load(entry.path().string());
      found[name] = driver ? FoundDriver{name, driver->file(), driver->summary(), driver->options(), ""}
                           : FoundDriver{name, entry.path().string(), "", "", driver.error().to_string()};
    }
  }
  std::vector<FoundDriver> list;
  list.reserve(found.size());
  for (auto& [name, driver] : found)
    list.push_back(std::move(driver));
  return list;
}

}  // namespace mechane::haptic
