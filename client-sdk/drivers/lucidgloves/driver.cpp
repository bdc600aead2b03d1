// LucidGloves, and gloves that follow them. The glove sends lines of text with the curls of the fingers, the driver
// sends lines with the limits of five servos. A servo stops the string of a finger: it brakes and cannot push. Never
// run on hardware.
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

#include <poll.h>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/lucidgloves/alpha.hpp"
#include "client-sdk/drivers/lucidgloves/brake.hpp"
#include "client-sdk/drivers/serial_port.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kLucidFresh = 50ms;     // a hand is of now: no brake on an older one
constexpr auto kLucidSilence = 500ms;  // without a hand: a fault
constexpr auto kKeepAlive = 50ms;      // the firmware has no watchdog, and a byte may be lost
constexpr int kLucidLookMs = 2;        // while open() waits
constexpr int kFullScales[] = {4095, 1023};

/// The firmware sends a line, and then waits up to a second for one of ours (Main.cpp, SerialCommunication.cpp). So
/// each hand is answered at once: otherwise the keep-alive would set the pace. The firmware reads one line for each
/// that it sends, so two answers to a hand would pile up in its buffer and act late.
class LucidGloves {
 public:
  static constexpr const char* kSummary =
      "LucidGloves and gloves that follow them (alpha encoding on a serial line); they brake the fingers";
  static constexpr const char* kOptions = "port=/dev/ttyUSB0 baud=115200 hand=right|left range=4095|1023 wait=SECONDS";

  LucidGloves() = default;
  ~LucidGloves() {
    if (!open_) return;
    for (int twice = 0; twice < 2; ++twice)  // the port drops a text while the rest of the one before is on its way
      send({});
  }
  LucidGloves(const LucidGloves&) = delete;
  LucidGloves& operator=(const LucidGloves&) = delete;

  Fault open(Options& options) {
    name_ = options.text("port", "/dev/ttyUSB0");
    const int baud = static_cast<int>(options.number("baud", 115200, 9600, 460800));
    side_ = options.hand_side();
    full_scale_ = kFullScales[options.choice("range", {"4095", "1023"})];
    const double wait_s = options.number("wait", 4, 0.1, 60);  // a board starts anew when its port is opened
    if (!options.fault().empty()) return options.fault();
    if (Fault fault = port_.open(name_, baud); !fault.empty()) return fault;
    open_ = true;
    stream_ = AlphaStream(full_scale_);
    // Start: newer firmware waits for it, older firmware takes it for a line without limits.
    if (Fault fault = port_.write("(ZA)\n"); !fault.empty()) return fault;
    return wait_for_hand(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait_s)));
  }

  Fault describe(mechane_device_info& info) {
    std::snprintf(info.name, sizeof(info.name), "LucidGloves (%s hand)", name_of_side(side_));
    info.hand = MECHANE_HAND_GLOVE;
    info.side = side_;
    info.output = MECHANE_OUTPUT_FINGER_BRAKE;
    info.rate_hz = 100;  // two lines of 45 and 25 bytes a round, at 115200 baud; servos take longer than this anyway
    return {};
  }

  Fault read(mechane_device_state& state) {
    if (Fault fault = receive(); !fault.empty()) return fault;
    if (Clock::now() - heard_at_ > kLucidSilence) return silence();
    const AlphaHand& hand = stream_.hand();
    if (hand.calibrated && Clock::now() - heard_at_ <= kLucidFresh) state.flags = MECHANE_STATE_READY;
    if (!hand.calibrated) state.flags = MECHANE_STATE_UNCALIBRATED;
    state.buttons = hand.buttons;
    place_joints(hand, state.joints_rad);
    state.grasp = grasp_of(hand);
    return {};
  }

  Fault write(const mechane_device_force& force) {
    return send_when_due(brakes_.follow(stream_.hand().curl, force.finger_n));
  }

 private:
  Fault wait_for_hand(Clock::duration wait) {
    const auto until = Clock::now() + wait;
    while (Clock::now() < until) {
      if (Fault fault = receive(); !fault.empty()) return fault;
      if (stream_.hands() > 0) return {};
      if (Fault fault = send_when_due({}); !fault.empty()) return fault;
      ::poll(nullptr, 0, kLucidLookMs);
    }
    return silence();
  }

  /// Takes what has arrived, once: a glove that sends without end does not hold up the caller.
  Fault receive() {
    std::size_t got = 0;
    const std::uint64_t before = stream_.hands();
    if (Fault fault = port_.read(buffer_, got); !fault.empty()) return fault;
    stream_.add({buffer_.data(), got});
    if (stream_.hands() == before) return {};
    heard_at_ = Clock::now();
    answer_due_ = true;
    return {};
  }

  Fault send_when_due(const StringLimits& limits) {
    if (limits == sent_ && !answer_due_ && Clock::now() - sent_at_ < kKeepAlive) return {};
    return send(limits);
  }

  Fault send(const StringLimits& limits) {
    sent_ = limits;
    sent_at_ = Clock::now();
    answer_due_ = false;
    AlphaText text;
    return port_.write(encode_limits(limits, text));
  }

  [[nodiscard]] Fault silence() const {
    const std::string glove = "the glove on " + name_;
    switch (stream_.trouble()) {
      case AlphaLine::malformed:
        return glove +
               " sends lines that are not alpha encoding: check the option baud and the ENCODING of its firmware";
      case AlphaLine::beyond_range:
        return glove + " sends numbers over " + std::to_string(full_scale_) +
               ": set the option range to the full scale of its board";
      default:
        return glove + " sends nothing: check that it is switched on, its cable, and the option port";
    }
  }

  SerialPort port_;
  std::string name_;
  std::uint32_t side_ = MECHANE_HAND_RIGHT;
  int full_scale_ = kFullScales[0];
  bool open_ = false;
  AlphaStream stream_{kFullScales[0]};
  FingerBrakes brakes_;
  StringLimits sent_{};
  bool answer_due_ = false;
  Clock::time_point sent_at_;  // long ago: the first line is due at once
  Clock::time_point heard_at_;
  std::array<char, 4096> buffer_{};
};

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::LucidGloves)
