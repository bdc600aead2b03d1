// Arms of the Phantom family, as Omni, Touch, Touch X and Premium, by the vendor's HD library. Source: OpenHaptics 3
// API Reference and Programmer's Guide. The vendor's own thread calls hd::Servo once a tick; read() waits for it and so
// is paced by it. What happens without faults allocates nothing here; whether the vendor's library does is not
// published.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/openhaptics/api.hpp"
#include "client-sdk/drivers/openhaptics/servo.hpp"
#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

constexpr auto kSilence = std::chrono::milliseconds(100);
constexpr auto kStart = std::chrono::seconds(1);
constexpr auto kFarewell = std::chrono::milliseconds(50);  // a tick or two; a device that is gone does not answer
constexpr double kPerThousand = 0.001;                     // mm to m, mN m to N m
constexpr double kThousand = 1000;                         // N/mm to N/m, N m to mN m
// Of an Omni or Touch, the weakest of the family, where the library does not know.
constexpr double kLeastPeak_n = 3.3, kLeastContinuous_n = 0.88;
constexpr double kGreatestForce_n = 100, kGreatestTorque_nm = 10;  // of driver.h
constexpr double kGreatestStiffness_n_per_m = 20000, kGreatestDamping_ns_per_m = 100;

class OpenHaptics {
 public:
  static constexpr const char* kSummary =
      "Phantom Omni, Desktop and Premium, Touch and Touch X, by the vendor's OpenHaptics";
  static constexpr const char* kOptions = "library=FILE name=NAME rate=HZ";

  OpenHaptics() = default;
  ~OpenHaptics() { close(); }
  OpenHaptics(const OpenHaptics&) = delete;
  OpenHaptics& operator=(const OpenHaptics&) = delete;

  Fault open(Options& options);
  Fault describe(mechane_device_info& info) {
    info = info_;
    return {};
  }
  Fault read(mechane_device_state& state);
  Fault write(const mechane_device_force& force);

 private:
  Fault attach(double rate_hz);
  void learn();
  void learn_workspace();
  Fault start(double rate_hz);
  void close() noexcept;
  bool answers(unsigned int parameter);
  double known(unsigned int parameter, double scale, double most, double otherwise);
  int integer(unsigned int parameter);
  Fault lost(const hd::ErrorInfo& error) const;

  hd::Api hd_;
  hd::Handle device_ = hd::kBadHandle;
  hd::Traits traits_;
  mechane_device_info info_{};
  std::array<double, 3> centre_mm_{};
  std::string name_;                  // empty: the default device
  std::unique_ptr<hd::Servo> servo_;  // while the scheduler runs
  unsigned long scheduled_ = 0;
};

Fault OpenHaptics::open(Options& options) {
  const std::string library = options.text("library", "");
  name_ = options.text("name", "");
  const double rate_hz = options.number("rate", 0, 500, 2000);
  if (!options.fault().empty()) return options.fault();
  if (Fault fault = hd::load(hd_, library); !fault.empty()) return fault;
  (void)hd::pop_errors(hd_);  // of an earlier session
  if (Fault fault = attach(rate_hz); !fault.empty()) return fault;
  learn();
  return start(rate_hz);
}

/// Initialises the device and switches its forces on; they flow when the scheduler runs.
Fault OpenHaptics::attach(double rate_hz) {
  device_ = hd_.init_device(name_.empty() ? nullptr : name_.c_str());
  hd::Errors errors = hd::pop_errors(hd_);
  if (device_ == hd::kBadHandle || errors.serious.code != 0) {
    return "the arm " + (name_.empty() ? "of the default name" : "'" + name_ + "'") +
           " does not open: " + hd::in_words(hd_, errors.serious) +
           ". Check its power, cable and name in the vendor's set-up program, close other programs that use it, and "
           "let this user read and write /dev/ttyACM*, /dev/hidraw* or /dev/fw*";
  }
  hd_.enable(hd::kForceOutput);
  errors = hd::pop_errors(hd_);
  if (errors.serious.code != 0)
    return "the arm does not switch its forces on: " + hd::in_words(hd_, errors.serious) +
           ". Try it in the vendor's own program";
  hd_.enable(hd::kMaxForceClamping);
  hd_.enable(hd::kForceRamping);
  (void)hd::pop_errors(hd_);  // not every model has these
  if (rate_hz == 0) return {};
  hd_.set_scheduler_rate(static_cast<unsigned long>(rate_hz));
  errors = hd::pop_errors(hd_);
  if (errors.serious.code != 0)
    return "the arm refuses that rate: " + hd::in_words(hd_, errors.serious) +
           ". Leave rate= out, or give 500, 1000 or 1600";
  return {};
}

/// What the device is. Every number of the library's is checked, for models differ in what they answer.
void OpenHaptics::learn() {
  const int styles = integer(hd::kCalibrationStyle);
  // The vendor's order of preference where a model has several.
  traits_.style = (styles & hd::kAuto) != 0      ? hd::kAuto
                  : (styles & hd::kInkwell) != 0 ? hd::kInkwell
                                                 : hd::kEncoderReset;
  traits_.gimbal = integer(hd::kInputDof) >= 6;
  traits_.torque = integer(hd::kOutputDof) >= 6;
  traits_.temperature = answers(hd::kMotorTemperature);

  const char* vendor = hd_.get_string(hd::kVendor);
  const char* model = hd_.get_string(hd::kModelType);
  std::snprintf(info_.name, sizeof info_.name, "%s %s", vendor == nullptr ? "Phantom" : vendor,
                model == nullptr ? "" : model);
  info_.hand = MECHANE_HAND_POINT;
  info_.output = MECHANE_OUTPUT_FORCE;
  info_.peak_force_n = known(hd::kNominalMaxForce, 1, kGreatestForce_n, kLeastPeak_n);
  info_.continuous_force_n =
      std::min(known(hd::kNominalMaxContinuousForce, 1, kGreatestForce_n, kLeastContinuous_n), info_.peak_force_n);
  if (traits_.torque) info_.peak_torque_nm = known(hd::kNominalMaxTorque, kPerThousand, kGreatestTorque_nm, 0);
  traits_.torque = info_.peak_torque_nm > 0;
  info_.max_stiffness_n_per_m = known(hd::kNominalMaxStiffness, kThousand, kGreatestStiffness_n_per_m, 0);
  info_.max_damping_ns_per_m = known(hd::kNominalMaxDamping, kThousand, kGreatestDamping_ns_per_m, 0);
  info_.paces = 1;
  learn_workspace();
}

void OpenHaptics::learn_workspace() {
  std::array<double, 6> box{};  // least x y z, greatest x y z, mm
  hd_.get_double(hd::kUsableWorkspace, box.data());
  (void)hd::pop_errors(hd_);
  for (std::size_t i = 0; i < 3; ++i)
    if (!(box[i] < box[i + 3] && box[i + 3] - box[i] < 2 * kThousand))
      return;  // not known: the library's origin is taken for the middle
  for (std::size_t i = 0; i < 3; ++i) {
    centre_mm_[i] = (box[i] + box[i + 3]) / 2;
    info_.workspace_min_m[i] = (box[i] - centre_mm_[i]) * kPerThousand;
    info_.workspace_max_m[i] = (box[i + 3] - centre_mm_[i]) * kPerThousand;
  }
}

Fault OpenHaptics::start(double rate_hz) {
  info_.rate_hz = rate_hz == 0 ? 1000 : rate_hz;
  traits_.ticks_a_second = static_cast<unsigned int>(info_.rate_hz);
  servo_ = std::make_unique<hd::Servo>(hd_, device_, traits_);
  scheduled_ = hd_.schedule_asynchronous(&hd::Servo::callback, servo_.get(), hd::kTopPriority);
  hd_.start_scheduler();
  const hd::Errors errors = hd::pop_errors(hd_);
  hd::Sample first;
  if (errors.serious.code == 0 && servo_->next(first, hd::Clock::now() + kStart))
    return first.lost.code == 0 ? Fault{} : lost(first.lost);
  return "the arm's scheduler does not start: " + hd::in_words(hd_, errors.serious) +
         ". Close other programs that use the arm, then unplug it and plug it in again";
}

Fault OpenHaptics::read(mechane_device_state& state) {
  const auto deadline = hd::Clock::now() + kSilence;
  hd::Sample sample;
  bool came = false;
  while (servo_->next(sample, deadline)) {
    if (sample.lost.code != 0) return lost(sample.lost);
    if (hd::convert(sample, traits_, centre_mm_, state)) return {};
    came = true;
    if (hd::Clock::now() >= deadline) break;
  }
  if (came)
    return "the arm has sent impossible positions for 0.1 s. Calibrate it in the vendor's program; if that does not "
           "help, its encoders or its cable are faulty";
  return "the arm's scheduler has not called for 0.1 s. Check the arm's power and cable, and that this computer is not "
         "overloaded";
}

Fault OpenHaptics::write(const mechane_device_force& force) {
  hd::Force wanted;
  wanted.force_n = limited(force.force_n, info_.peak_force_n);
  wanted.torque_mnm = limited(force.torque_nm, info_.peak_torque_nm);
  for (double& t : wanted.torque_mnm)
    t *= kThousand;
  wanted.asked = hd::Clock::now();
  servo_->render(wanted);
  return {};
}

/// Zero force for one tick, then in the vendor's order.
void OpenHaptics::close() noexcept {
  if (servo_ != nullptr) {
    hd::Force farewell;
    farewell.last = true;
    servo_->render(farewell);
    const bool ended = servo_->ended(hd::Clock::now() + kFarewell);
    hd_.stop_scheduler();
    if (!ended) hd_.unschedule(scheduled_);
  }
  if (device_ != hd::kBadHandle) hd_.disable_device(device_);
}

bool OpenHaptics::answers(unsigned int parameter) {
  std::array<double, 16> values{};  // the longest answer that there is
  hd_.get_double(parameter, values.data());
  return hd::pop_errors(hd_).serious.code == 0;
}

/// One number, times `scale`; `otherwise` when the library has none, or none from 0 to `most`.
double OpenHaptics::known(unsigned int parameter, double scale, double most, double otherwise) {
  std::array<double, 16> values{};
  hd_.get_double(parameter, values.data());
  const double value = values[0] * scale;
  return hd::pop_errors(hd_).serious.code == 0 && value > 0 && value <= most ? value : otherwise;
}

int OpenHaptics::integer(unsigned int parameter) {
  int value = 0;
  hd_.get_integer(parameter, &value);
  return hd::pop_errors(hd_).serious.code == 0 ? value : 0;
}

Fault OpenHaptics::lost(const hd::ErrorInfo& error) const {
  return "the arm is lost: " + hd::in_words(hd_, error) + ". Check its power and cable; it is opened again by itself";
}

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::OpenHaptics)
