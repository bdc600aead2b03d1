// Hand tracking of any program (an OpenXR or WebXR application, a camera with MediaPipe) that sends the joints of a hand
// to a local socket: see hand_datagram.hpp. It reads the hand and does nothing to it. Never run with a real tracker.
#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/joints/datagram_port.hpp"
#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include "client-sdk/drivers/joints/hand_geometry.hpp"
#include "client-sdk/drivers/joints/hand_measure.hpp"

namespace mechane::drivers {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto kPace = 40ms;     // read() waits so long for a hand; a state that is 50 ms old is a lost device
constexpr auto kFresh = 100ms;   // how long a hand is current: a lower number is then a late datagram, not a new sender
constexpr auto kLetsGo = 500ms;  // a hand that is not tracked for so long opens: it must not hold on where it was last
constexpr auto kNextVisitor = 5s;  // a hand that comes after such a pause may be another person's
constexpr int kAtOnce = 64;        // datagrams
constexpr int kMalformedInARow = 50;

Clock::duration seconds(double number) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(number));
}

/// "0.1/0/-0.3"; false when it is not three numbers within 10 m.
bool read_origin(std::string_view text, HandPoint& out) {
  for (std::size_t axis = 0; axis < out.size(); ++axis) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out[axis]);
    if (error != std::errc{} || !(std::abs(out[axis]) <= 10)) return false;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (axis == 2) return text.empty();
    if (!text.starts_with('/')) return false;
    text.remove_prefix(1);
  }
  return false;
}

class Joints {
 public:
  static constexpr const char* kSummary =
      "hand tracking of another program (OpenXR, WebXR, MediaPipe), from a local socket; it reads the hand";
  static constexpr const char* kOptions =
      "port=9680 socket=FILE hand=right|left origin=X/Y/Z yaw=DEGREES wait=SECONDS silence=SECONDS";

  Fault open(Options& options) {
    side_ = options.hand_side();
    const double yaw = options.number("yaw", 0, -360, 360) * std::numbers::pi / 180;
    cos_yaw_ = std::cos(yaw);
    sin_yaw_ = std::sin(yaw);
    const double wait_s = options.number("wait", 3, 0.1, 25);
    silence_ = seconds(options.number("silence", 2, 0.2, 3600));
    const std::string origin = options.text("origin", "0/0/0");
    if (!read_origin(origin, origin_))
      return "the option origin=" + origin + " is not three numbers within 10 m, as in origin=0/-0.2/0.4";
    std::ranges::copy(origin_, hand_.position_m);
    hand_.orientation_wxyz[0] = 1;
    hand_.temperature = -1;
    if (Fault fault = listen(options); !fault.empty()) return fault;
    return wait_for_hand(seconds(wait_s));
  }

  Fault describe(mechane_device_info& info) {
    std::snprintf(info.name, sizeof(info.name), "Hand tracking (%s hand)", name_of_side(side_));
    info.hand = MECHANE_HAND_GLOVE;
    info.side = side_;
    info.output = MECHANE_OUTPUT_NONE;
    info.rate_hz = 100;
    info.paces = 1;
    return {};
  }

  Fault read(mechane_device_state& state) {
    if (Fault fault = receive(kPace); !fault.empty()) return fault;
    const auto now = Clock::now();
    if (now - heard_at_ > silence_) return silence();
    state = hand_;
    if (tracked_ && now - heard_at_ <= kFresh) state.flags = MECHANE_STATE_READY;
    if (now - tracked_at_ <= kLetsGo) return {};
    std::ranges::fill(state.joints_rad, 0.0);
    state.grasp = 0;
    return {};
  }

  Fault write(const mechane_device_force&) { return {}; }

 private:
  Fault listen(Options& options) {
    const std::string file = options.text("socket", "");
    const bool port_given = !options.text("port", "").empty();
    const auto port = static_cast<std::uint16_t>(options.number("port", 9680, 1, 65535));
    if (!options.fault().empty()) return options.fault();
    if (!file.empty() && port_given) return "the options port and socket exclude each other: give one of them";
    where_ = file.empty() ? "UDP port " + std::to_string(port) + " of 127.0.0.1" : "the socket " + file;
    return file.empty() ? port_.open_udp(port) : port_.open_socket(file);
  }

  Fault wait_for_hand(Clock::duration wait) {
    const auto until = Clock::now() + wait;
    while (Clock::now() < until) {
      if (Fault fault = receive(kPace); !fault.empty()) return fault;
      if (heard_at_ != Clock::time_point{}) return {};
    }
    return silence();
  }

  /// Returns as soon as this hand has come.
  Fault receive(std::chrono::milliseconds patience) {
    const auto until = Clock::now() + patience;
    const auto before = heard_at_;
    for (auto left = patience; left > 0ms && heard_at_ == before;) {
      port_.wait(left);
      if (Fault fault = take_all(); !fault.empty()) return fault;
      left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    }
    return {};
  }

  /// What has come; at most so much that a program that sends without end does not hold up the caller.
  Fault take_all() {
    for (int i = 0; i < kAtOnce; ++i) {
      ssize_t length = 0;
      if (Fault fault = port_.receive(buffer_, length); !fault.empty()) return fault;
      if (length < 0) return {};
      const auto size = static_cast<std::size_t>(length);
      malformed_ = size > buffer_.size() ? "it is longer than 16 KiB" : take({buffer_.data(), size});
      malformed_in_a_row_ = *malformed_ == '\0' ? 0 : malformed_in_a_row_ + 1;
      if (malformed_in_a_row_ >= kMalformedInARow) return silence();
    }
    return {};
  }

  /// Returns "", or what is wrong with the datagram.
  const char* take(std::string_view text) {
    HandDatagram hand;
    if (const char* const why = parse_hand_datagram(text, hand); *why != '\0') return why;
    other_hand_ = hand.left != (side_ == MECHANE_HAND_LEFT);
    if (other_hand_) return "";
    const auto now = Clock::now();
    if (hand.sequence && sequence_ && *hand.sequence <= *sequence_ && now - heard_at_ <= kFresh) return "";
    if (hand.tracked) {
      for (HandPoint& point : hand.points)
        point = in_D(point);
      if (const char* const why = place_tracked_hand(hand, hand_); *why != '\0') return why;
      if (now - tracked_at_ > kNextVisitor) measure_ = {};
      measure_.add(hand.points);
      measure_.tell(hand_);
      tracked_at_ = now;
    }
    sequence_ = hand.sequence;
    tracked_ = hand.tracked;
    heard_at_ = now;
    return "";
  }

  [[nodiscard]] HandPoint in_D(const HandPoint& p) const noexcept {
    return {origin_[0] + cos_yaw_ * p[0] + sin_yaw_ * p[2], origin_[1] + p[1],
            origin_[2] - sin_yaw_ * p[0] + cos_yaw_ * p[2]};
  }

  [[nodiscard]] Fault silence() const {
    if (*malformed_ != '\0')
      return "what arrives at " + where_ + " is not a hand: " + malformed_ + "; correct the program that sends it";
    if (other_hand_) {
      const std::string other = name_of_side(MECHANE_HAND_LEFT - side_);
      return "only the " + other + " hand arrives at " + where_ + ": set the option hand=" + other + ", or send the " +
             name_of_side(side_) + " hand";
    }
    return "no hand arrives at " + where_ + ": start the tracking program, and check where it sends to";
  }

  DatagramPort port_;
  std::string where_;  // "UDP port 9680 of 127.0.0.1"
  std::uint32_t side_ = MECHANE_HAND_RIGHT;
  HandPoint origin_{};
  double cos_yaw_ = 1, sin_yaw_ = 0;
  Clock::duration silence_{};
  Clock::time_point heard_at_, tracked_at_;
  bool tracked_ = false;
  bool other_hand_ = false;     // the newest datagram was of the other one
  const char* malformed_ = "";  // the newest datagram, why
  int malformed_in_a_row_ = 0;
  std::optional<std::uint64_t> sequence_;
  mechane_device_state hand_{};  // the newest that was tracked
  HandMeasure measure_;
  std::array<char, kLongestHandDatagram> buffer_{};
};

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::Joints)
