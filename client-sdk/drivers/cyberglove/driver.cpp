// CyberGlove with 18 or 22 sensors on a serial line: it reads the hand and does nothing to it. Never run on hardware.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

#include <poll.h>

#include "client-sdk/drivers/cyberglove/calibration.hpp"
#include "client-sdk/drivers/cyberglove/record.hpp"
#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/serial_port.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kCyberSilence = 500ms;  // without a record: a fault
constexpr auto kStartAgain = 500ms;    // the box may have been off, or busy, when it was told to start
constexpr int kCyberLookMs = 2;        // while open() waits
constexpr std::size_t kSensorCounts[] = {22, 18};

class CyberGlove {
 public:
  static constexpr const char* kSummary = "CyberGlove with 18 or 22 sensors on a serial line; it reads the hand";
  static constexpr const char* kOptions =
      "port=/dev/ttyUSB0 baud=115200 sensors=22|18 hand=right|left calibration=FILE wait=SECONDS";

  CyberGlove() = default;
  ~CyberGlove() {
    if (open_) (void)port_.write(kStopCommands);
  }
  CyberGlove(const CyberGlove&) = delete;
  CyberGlove& operator=(const CyberGlove&) = delete;

  Fault open(Options& options) {
    name_ = options.text("port", "/dev/ttyUSB0");
    baud_ = static_cast<int>(options.number("baud", 115200, 9600, 460800));
    sensors_ = kSensorCounts[options.choice("sensors", {"22", "18"})];
    side_ = options.hand_side();
    const std::string file = options.text("calibration", "");
    const double wait_s = options.number("wait", 3, 0.1, 60);
    if (!options.fault().empty()) return options.fault();
    records_ = GloveRecords(sensors_);
    calibration_ = GloveCalibration(sensors_);
    calibrated_ = !file.empty();
    if (Fault fault = calibrated_ ? calibrate(file) : Fault(); !fault.empty()) return fault;
    if (Fault fault = port_.open(name_, baud_); !fault.empty()) return fault;
    open_ = true;
    return wait_for_record(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s)));
  }

  Fault describe(mechane_device_info& info) {
    std::snprintf(info.name, sizeof(info.name), "CyberGlove, %s hand, %d sensors%s", name_of_side(side_),
                  static_cast<int>(sensors_), calibrated_ ? "" : ", not calibrated");
    info.hand = MECHANE_HAND_GLOVE;
    info.side = side_;
    info.output = MECHANE_OUTPUT_NONE;
    info.rate_hz = 100;
    return {};
  }

  Fault read(mechane_device_state& state) {
    if (Fault fault = receive(); !fault.empty()) return fault;
    if (Clock::now() - heard_at_ > kCyberSilence) return silence();
    state.flags = MECHANE_STATE_READY;  // it renders no force that a wrong angle could misplace
    calibration_.place_joints(records_.newest(), state.joints_rad);
    state.grasp = grasp_of(state.joints_rad);
    return {};
  }

  Fault write(const mechane_device_force&) { return {}; }

 private:
  Fault calibrate(const std::string& file) {
    std::string text(std::size_t{64} * 1024, '\0');  // a calibration is shorter
    std::ifstream in(file, std::ios::binary);
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (in.gcount() == 0) return "cannot read the calibration " + file + "; is the option calibration right?";
    text.resize(static_cast<std::size_t>(in.gcount()));
    const std::string fault = calibration_.take_text(text);
    return fault.empty() ? Fault() : "the calibration " + file + " is not right: " + fault;
  }

  Fault wait_for_record(Clock::duration wait) {
    const std::string start = start_commands(baud_, sensors_);
    const auto begun = Clock::now();
    auto start_at = begun;
    for (auto now = begun; now < begun + wait; now = Clock::now()) {
      if (now >= start_at) {
        if (Fault fault = port_.write(start); !fault.empty()) return fault;
        start_at = now + kStartAgain;
      }
      if (Fault fault = receive(); !fault.empty()) return fault;
      if (records_.count() > 0) return {};
      ::poll(nullptr, 0, kCyberLookMs);
    }
    return silence();
  }

  /// Takes what has arrived, once: a box that sends without end does not hold up the caller.
  Fault receive() {
    std::size_t got = 0;
    const std::uint64_t before = records_.count();
    if (Fault fault = port_.read(buffer_, got); !fault.empty()) return fault;
    records_.add({buffer_.data(), got});
    if (records_.count() != before) heard_at_ = Clock::now();
    if (records_.newest().unplugged) return "the box on " + name_ + " has no glove: plug the glove into the box";
    return {};
  }

  [[nodiscard]] Fault silence() const {
    if (!records_.noise())
      return "the glove on " + name_ + " sends nothing: check that its box is on, its cable, and the option port";
    return "the glove on " + name_ + " sends no records of " + std::to_string(sensors_) +
           " sensors: check the options sensors and baud";
  }

  SerialPort port_;
  std::string name_;
  int baud_ = 0;
  std::size_t sensors_ = kSensorCounts[0];
  std::uint32_t side_ = MECHANE_HAND_RIGHT;
  bool calibrated_ = false;
  bool open_ = false;
  GloveRecords records_{kSensorCounts[0]};
  GloveCalibration calibration_{kSensorCounts[0]};
  Clock::time_point heard_at_;
  std::array<char, 4096> buffer_{};
};

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::CyberGlove)
