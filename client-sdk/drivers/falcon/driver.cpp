// Novint Falcon by libftdi, without the maker's software. Facts: libnifalcon. Not tried on hardware. Not certain are:
// the zero of the encoders (see kinematics.hpp), which way a motor turns (as libnifalcon has it), and what the board
// does when commands stop coming. Its motors know no newton: without an option that says what they do, nothing is
// rendered.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/falcon/board.hpp"
#include "client-sdk/drivers/falcon/kinematics.hpp"
#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using falcon::Triple;

constexpr auto kFalconStale = 20ms;     // a hand is of now: no force on an older one
constexpr auto kFalconSilence = 100ms;  // without a position: a fault
constexpr int kFarewells = 3;           // one may be lost
// Frames have no check sum. A position is not believed that no hand reaches in the time since the last one.
constexpr double kJump_m = 0.002, kFastest_m_per_s = 3;
constexpr double kFarthest_m = 0.1;  // from the middle: more than the legs reach
// Of CHAI3D, CDeltaDevices.cpp. No source has a continuous force.
constexpr double kForce_n = 8, kStiffness_n_per_m = 3000, kDamping_ns_per_m = 20, kRadius_m = 0.04;
constexpr std::size_t kLargestImage = std::size_t{128} * 1024;

class Falcon {
 public:
  static constexpr const char* kSummary = "Novint Falcon, by libftdi; it reads the hand, and renders when calibrated";
  static constexpr const char* kOptions = "firmware=FILE counts_per_newton=NUMBER device=NUMBER library=FILE";

  Falcon() = default;
  ~Falcon() { close(); }
  Falcon(const Falcon&) = delete;
  Falcon& operator=(const Falcon&) = delete;

  Fault open(Options& options);
  Fault describe(mechane_device_info& info);
  Fault read(mechane_device_state& state);
  Fault write(const mechane_device_force& force);

 private:
  Fault start();
  Fault ask(const std::array<int, 3>& motors);
  void take(const falcon::Answer& answer, Clock::time_point now);
  [[nodiscard]] bool ready(Clock::time_point now) const { return posed_ && now - sound_ <= kFalconStale; }
  [[nodiscard]] double reachable_force() const;
  [[nodiscard]] std::array<int, 3> motors_for(const Triple& force_n) const;
  [[nodiscard]] Fault silence(Clock::time_point now) const;
  void close() noexcept;

  falcon::Board board_;
  falcon::Answers answers_;
  std::string file_;  // of the firmware
  std::vector<std::uint8_t> image_;
  double counts_per_newton_ = 0;  // of a motor, for a newton at the end of its thigh; 0: not known
  double peak_force_n_ = 0;
  bool asked_ = false;         // a command waits for its answer
  bool posed_ = false;         // all legs know their angles; these are the last that were sound
  Clock::time_point heard_{};  // when the last answer came
  Clock::time_point sound_{};  // when the last sound one came
  Triple angles_rad_{};
  Triple position_m_{};  // in the base's frame
  unsigned buttons_ = 0;
};

Fault Falcon::open(Options& options) {
  const std::string library = options.text("library", "");
  const auto device = static_cast<unsigned>(options.number("device", 0, 0, 15));
  file_ = options.text("firmware", "");
  counts_per_newton_ = options.number("counts_per_newton", 0, 0, 10000);
  if (!options.fault().empty()) return options.fault();
  peak_force_n_ = counts_per_newton_ > 0 ? std::min(kForce_n, reachable_force()) : 0;
  if (!file_.empty()) {
    std::ifstream in(file_, std::ios::binary);
    image_.resize(kLargestImage);
    in.read(reinterpret_cast<char*>(image_.data()), static_cast<std::streamsize>(image_.size()));
    image_.resize(static_cast<std::size_t>(in.gcount()));
    if (image_.empty()) return "cannot read the firmware " + file_ + ": is the option firmware right?";
    if (image_.size() == kLargestImage) return file_ + " is too large for a Falcon's firmware";
  }
  if (Fault fault = board_.open(library, device); !fault.empty()) return fault;
  return start();
}

/// A board that has kept its power has kept its program, and knows the angles of its legs.
Fault Falcon::start() {
  bool runs = false;
  if (Fault fault = board_.look(runs); !fault.empty()) return fault;
  if (!runs && image_.empty())
    return "the Falcon has no firmware: it forgets it when its power goes. Get Novint's (libnifalcon has it as "
           "nvent_firmware.bin; not for commercial use) and give it as firmware=FILE";
  if (!runs)
    if (Fault fault = board_.start(image_); !fault.empty()) return fault;
  sound_ = Clock::now();
  return ask({});
}

Fault Falcon::describe(mechane_device_info& info) {
  std::snprintf(info.name, sizeof info.name, "Novint Falcon%s", counts_per_newton_ > 0 ? "" : ", not calibrated");
  info.hand = MECHANE_HAND_POINT;
  info.output = counts_per_newton_ > 0 ? MECHANE_OUTPUT_FORCE : MECHANE_OUTPUT_NONE;
  info.peak_force_n = peak_force_n_;
  info.continuous_force_n = peak_force_n_ / 2;
  info.max_stiffness_n_per_m = kStiffness_n_per_m;
  info.max_damping_ns_per_m = kDamping_ns_per_m;
  info.rate_hz = 1000;  // USB has a frame a millisecond
  info.paces = 1;
  std::fill_n(info.workspace_min_m, 3, -kRadius_m);
  std::fill_n(info.workspace_max_m, 3, kRadius_m);
  return {};
}

Fault Falcon::read(mechane_device_state& state) {
  if (!asked_)
    if (Fault fault = ask({}); !fault.empty()) return fault;
  asked_ = false;
  const std::uint64_t before = answers_.count();
  if (Fault fault = board_.receive(answers_); !fault.empty()) return fault;
  const auto now = Clock::now();
  if (answers_.count() != before) {
    heard_ = now;
    take(answers_.newest(), now);
  }
  if (now - sound_ > kFalconSilence) return silence(now);
  if (ready(now)) state.flags = MECHANE_STATE_READY;
  state.buttons = buttons_;
  if (!posed_) {
    state.flags = MECHANE_STATE_UNCALIBRATED;
    return {};
  }
  for (std::size_t i = 0; i < 3; ++i)
    state.position_m[i] = position_m_[i] - falcon::kMiddle_m[i];
  return {};
}

/// What has no sound position is skipped. A board that looks for the ends of its legs has none yet, and is sound.
void Falcon::take(const falcon::Answer& answer, Clock::time_point now) {
  if (!answer.all_homed()) {
    posed_ = false;
  } else {
    Triple angles{}, position{};
    for (std::size_t leg = 0; leg < 3; ++leg)
      angles[leg] = falcon::thigh_angle(answer.counts[leg]);
    if (!falcon::grip_position(angles, position)) return;
    const double since_s = std::chrono::duration<double>(now - sound_).count();
    const double farthest_m = posed_ ? kJump_m + kFastest_m_per_s * since_s : kFarthest_m;
    const Triple& from = posed_ ? position_m_ : falcon::kMiddle_m;
    if (std::hypot(position[0] - from[0], position[1] - from[1], position[2] - from[2]) > farthest_m) return;
    angles_rad_ = angles;
    position_m_ = position;
    posed_ = true;
  }
  buttons_ = answer.buttons;
  sound_ = now;
}

Fault Falcon::write(const mechane_device_force& force) {
  return ask(ready(Clock::now()) ? motors_for(limited(force.force_n, peak_force_n_)) : std::array<int, 3>{});
}

Fault Falcon::ask(const std::array<int, 3>& motors) {
  asked_ = true;
  return board_.send(falcon::command(motors, ready(Clock::now()) ? falcon::kGreen : falcon::kRed));
}

/// What the motors give at the middle of the workspace in their weakest direction, N.
double Falcon::reachable_force() const {
  std::array<Triple, 3> torques{};  // for a newton along each axis
  Triple angles{};
  (void)falcon::thigh_angles(falcon::kMiddle_m, angles);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Triple newton{};
    newton[axis] = 1;
    (void)falcon::thigh_torques(angles, falcon::kMiddle_m, newton, torques[axis]);
  }
  double arm_m = 0;  // the longest by which a force at the grip turns a thigh
  for (std::size_t leg = 0; leg < 3; ++leg)
    arm_m = std::max(arm_m, std::hypot(torques[0][leg], torques[1][leg], torques[2][leg]));
  return falcon::kMostMotor / counts_per_newton_ * falcon::kThigh_m / arm_m;
}

/// All three are scaled together where one is at its limit, so that the force keeps its direction. A positive number
/// turns a thigh outwards, against its angle.
std::array<int, 3> Falcon::motors_for(const Triple& force_n) const {
  Triple motors{};
  if (!falcon::thigh_torques(angles_rad_, position_m_, force_n, motors)) return {};
  double most = falcon::kMostMotor;
  for (double& motor : motors) {
    motor *= -counts_per_newton_ / falcon::kThigh_m;
    most = std::max(most, std::abs(motor));
  }
  std::array<int, 3> whole{};
  for (std::size_t leg = 0; leg < 3; ++leg)
    whole[leg] = static_cast<int>(std::lround(motors[leg] * (falcon::kMostMotor / most)));
  return whole;
}

Fault Falcon::silence(Clock::time_point now) const {
  if (now - heard_ <= kFalconSilence)
    return "the Falcon has sent impossible angles for 0.1 s. Switch it off and on, then pull its grip all the way out "
           "and push it all the way in; if that does not help, its encoders are faulty";
  if (answers_.noise())
    return "the Falcon has sent only torn data for 0.1 s. Check its cable, and plug it into another USB socket";
  return "the Falcon has sent nothing for 0.1 s. Check its power and cable; it is opened again by itself";
}

void Falcon::close() noexcept {
  if (!board_.is_open()) return;
  const falcon::Command farewell = falcon::command({}, falcon::kRed);
  for (int i = 0; i < kFarewells; ++i)
    if (!board_.send(farewell).empty()) return;
}

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::Falcon)
