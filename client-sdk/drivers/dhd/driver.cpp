// Force Dimension's delta, omega, sigma and lambda and Novint's Falcon, by Force Dimension's library. Source: dhdc.h
// and drdc.h of its SDK 3.17 as published with CHAI3D. The driver calls the library; read() and write() wait for the
// library's transfers and for nothing else. What happens without faults allocates nothing here; whether the vendor's
// library does is not published.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include "client-sdk/drivers/dhd/api.hpp"
#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kSilence = std::chrono::milliseconds(100);
// Between two tries to switch a force on that the device has switched off.
constexpr auto kRest = std::chrono::milliseconds(200);
constexpr double kReach_m = 1;            // more than any model's
constexpr double kGreatestForce_n = 100;  // of driver.h
constexpr int kStatusEvery = 20;          // reads: often enough for a person, and seldom enough for the line

class Dhd {
 public:
  static constexpr const char* kSummary =
      "Force Dimension delta, omega, sigma and lambda, Novint Falcon, by the vendor's libdrd";
  static constexpr const char* kOptions = "library=FILE device=NUMBER auto_init=no|yes";

  Dhd() = default;
  ~Dhd() { close(); }
  Dhd(const Dhd&) = delete;
  Dhd& operator=(const Dhd&) = delete;

  Fault open(Options& options);
  Fault describe(mechane_device_info& info);
  Fault read(mechane_device_state& state);
  Fault write(const mechane_device_force& force);

 private:
  Fault initialise(bool may_move);
  Fault switch_on();
  Fault look();
  bool sample(mechane_device_state& state, int& result);
  int render(const std::array<double, 3>& force_n, const std::array<double, 3>& torque_nm);
  void close() noexcept;
  [[nodiscard]] bool ready() const { return initialised_ && force_on_; }
  [[nodiscard]] Fault failed(const std::string& what) const;

  dhd::Api dhd_;
  int device_ = -1;
  const dhd::Model* model_ = &dhd::model_of(-1);
  double peak_force_n_ = 0;
  bool initialised_ = false;
  bool force_on_ = false;
  bool dead_man_ = false;
  bool pushing_ = false;  // the last force was not zero
  int reads_ = 0;
  Clock::time_point switched_on_{};
  Clock::time_point sound_{};  // when last_ was read
  mechane_device_state last_{};
};

Fault Dhd::open(Options& options) {
  const std::string library = options.text("library", "");
  const double index = options.number("device", 0, 0, 15);
  const bool may_move = options.choice("auto_init", {"no", "yes"}) == 1;
  if (!options.fault().empty()) return options.fault();
  if (Fault fault = dhd::load(dhd_, library); !fault.empty()) return fault;
  device_ = dhd_.drd_open(static_cast<char>(index));
  if (device_ < 0) {
    return failed("device " + std::to_string(static_cast<int>(index)) + " does not open") +
           ". Check its power and cable, that no other program uses it, and this user's right to the USB device 1451 "
           "(Falcon: 0403:cb48)";
  }
  const char id = static_cast<char>(device_);
  model_ = &dhd::model_of(dhd_.system_type(id));
  const double limit_n = dhd_.max_force == nullptr ? 0 : dhd_.max_force(id);
  peak_force_n_ = limit_n > 0 && limit_n <= kGreatestForce_n ? limit_n : model_->force_n;
  last_.orientation_wxyz[0] = 1;
  last_.temperature = -1;
  sound_ = Clock::now();
  return initialise(may_move);
}

/// Finds the arm's zero, which it does by moving: only where the technician has allowed that. Without it the arm is
/// read, and not ready.
Fault Dhd::initialise(bool may_move) {
  const char id = static_cast<char>(device_);
  initialised_ = dhd_.drd_is_initialized(id);
  if (!initialised_ && may_move) {
    if (dhd_.drd_auto_init(id) < 0)
      return failed("the arm did not find its zero") + ". Clear its way, hold nothing, and start again";
    initialised_ = true;
  }
  if (dhd_.drd_stop(true, id) < 0)
    return failed("the arm does not leave its own regulation") + ". Switch it off and on";
  return initialised_ ? switch_on() : Fault{};
}

/// No force before the arm knows where it is: its weight would be carried in a wrong direction.
Fault Dhd::switch_on() {
  const char id = static_cast<char>(device_);
  switched_on_ = Clock::now();
  if (render({}, {}) < 0 || dhd_.gravity_compensation(1, id) < 0 || dhd_.brakes(0, id) < 0 ||
      dhd_.enable_force(1, id) < 0)
    return failed("the arm does not switch its forces on") + ". Switch it off and on";
  return {};
}

Fault Dhd::describe(mechane_device_info& info) {
  std::snprintf(info.name, sizeof info.name, "%s%s", model_->name, initialised_ ? "" : " (needs auto_init=yes)");
  info.hand = MECHANE_HAND_POINT;
  info.output = MECHANE_OUTPUT_FORCE;
  info.peak_force_n = peak_force_n_;
  info.continuous_force_n = peak_force_n_ / 2;  // the vendor publishes none that was found
  info.peak_torque_nm = model_->torque_nm;
  info.max_stiffness_n_per_m = model_->stiffness_n_per_m;
  info.max_damping_ns_per_m = model_->damping_ns_per_m;
  info.rate_hz = 1000;
  for (double& edge : info.workspace_min_m)
    edge = -model_->radius_m;
  for (double& edge : info.workspace_max_m)
    edge = model_->radius_m;
  return {};
}

Fault Dhd::read(mechane_device_state& state) {
  if (reads_++ % kStatusEvery == 0)
    if (Fault fault = look(); !fault.empty()) return fault;
  int result = 0;
  const bool sound = sample(state, result);
  if (result < 0) return failed("the arm is lost") + ". Check its power and cable; it is opened again by itself";
  const auto now = Clock::now();
  if (sound) {
    sound_ = now;
    last_ = state;
  } else {
    if (now - sound_ > kSilence)
      return "the arm has sent impossible positions for 0.1 s. Switch it off and on, and start it with auto_init=yes; "
             "if that does not help, its encoders or its cable are faulty";
    state = last_;
  }
  state.flags = dead_man_ ? MECHANE_STATE_DEAD_MAN : 0;
  if (!initialised_) state.flags |= MECHANE_STATE_UNCALIBRATED;
  if (sound && ready()) state.flags |= MECHANE_STATE_READY;
  return {};
}

/// One sample in D; `result` is below 0 where the library failed. False when it holds numbers that no such device can
/// have.
bool Dhd::sample(mechane_device_state& state, int& result) {
  const char id = static_cast<char>(device_);
  std::array<double, 3> position{};
  result = dhd_.position(&position[0], &position[1], &position[2], id);
  if (result < 0) return false;
  position = dhd::to_d(position);
  std::copy(position.begin(), position.end(), state.position_m);
  state.buttons = dhd_.buttons(id);
  bool sound = std::all_of(position.begin(), position.end(), [](double p) { return std::abs(p) < kReach_m; });
  if (model_->wrist) {
    double by_rows[3][3] = {};
    result = dhd_.orientation(by_rows, id);
    sound = sound && dhd::orientation_to_d(by_rows, state.orientation_wxyz);
  }
  return sound;
}

/// What the device says of itself now. A force that it switched off for a hand that was too fast, or for too long a
/// silence, is switched on again when none is asked for; what a person switches off, by a button or by letting go, a
/// person switches on.
Fault Dhd::look() {
  const char id = static_cast<char>(device_);
  std::array<int, dhd::kStatusRoom> status{};
  if (dhd_.status(status.data(), id) < 0)
    return failed("the arm is lost") + ". Check its power and cable; it is opened again by itself";
  const int cause = status[dhd::kStatusForceOffCause];
  force_on_ = status[dhd::kStatusForce] != 0;
  dead_man_ = !force_on_ && cause == dhd::kDeadMan;
  if (!force_on_ && cause == dhd::kUnplugged)
    return "the arm is unplugged. Plug its USB cable in; it is opened again by itself";
  if (status[dhd::kStatusError] != 0) return failed("the arm reports a fault of its own") + ". Switch it off and on";
  if (!initialised_) {
    initialised_ = dhd_.drd_is_initialized(id);  // some models can be moved to their zero by hand
    return initialised_ ? switch_on() : Fault{};
  }
  const bool by_person = cause == dhd::kButton || cause == dhd::kDeadMan;
  return force_on_ || by_person || pushing_ || Clock::now() - switched_on_ < kRest ? Fault{} : switch_on();
}

Fault Dhd::write(const mechane_device_force& force) {
  const std::array<double, 3> force_n = ready() ? limited(force.force_n, peak_force_n_) : std::array<double, 3>{};
  const std::array<double, 3> torque_nm =
      ready() ? limited(force.torque_nm, model_->torque_nm) : std::array<double, 3>{};
  if (render(force_n, torque_nm) >= 0) return {};
  return failed("the arm takes no force") + ". Check its power and cable; it is opened again by itself";
}

/// N and N m in D.
int Dhd::render(const std::array<double, 3>& force_n, const std::array<double, 3>& torque_nm) {
  constexpr std::array<double, 3> kZero{};
  pushing_ = force_n != kZero || torque_nm != kZero;
  const char id = static_cast<char>(device_);
  const auto f = dhd::from_d(force_n);
  if (model_->torque_nm == 0) return dhd_.set_force(f[0], f[1], f[2], id);
  const auto t = dhd::from_d(torque_nm);
  return dhd_.set_force_torque_grip(f[0], f[1], f[2], t[0], t[1], t[2], 0, id);
}

void Dhd::close() noexcept {
  if (device_ < 0) return;
  (void)render({}, {});
  (void)dhd_.enable_force(0, static_cast<char>(device_));
  (void)dhd_.drd_close(static_cast<char>(device_));
}

Fault Dhd::failed(const std::string& what) const {
  const char* why = dhd_.last_error();
  return what + ": '" + (why == nullptr ? "unknown error" : why) + "'";
}

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::Dhd)
