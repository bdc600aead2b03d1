// Haply Inverse3, with or without a grip, by way of Haply's local service, formats 3.1 and 3.5.
// Facts: docs.haply.co, Inverse SDK: WebSocket Protocol, Simulation Channel, Control Commands, Basis Permutation, Mount
// & Workspace.
// Not tried on hardware.
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/haply/force_watch.hpp"
#include "client-sdk/drivers/haply/link.hpp"
#include "client-sdk/drivers/haply/protocol.hpp"
#include "client-sdk/drivers/vectors.hpp"

namespace mechane::drivers {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr double kRateHz = 1000;
constexpr milliseconds kAnswer{2};      // of read(); an answer comes within a fraction of one
constexpr milliseconds kOpening{2000};  // for each message while the arm is opened
constexpr milliseconds kFresh{20};      // a state of the arm is of now
constexpr milliseconds kSilence{1000};  // without a whole state: a fault
constexpr int kMalformedInARow = 20;
constexpr int kOpeningTicks = 5;  // with no force, until the service has put the origin where we want it
constexpr int kMessagesAtOnce = 8;

// Other clients' limits; Haply publishes neither its peak nor what the motors bear all day, so the latter is a careful
// guess.
constexpr double kPeakForceN = 10;
constexpr double kContinuousForceN = 3;
constexpr double kStiffnessNPerM = 1000;
constexpr double kDampingNsPerM = 6;
constexpr double kWorkspaceRadiusM = 0.15;

// The middle of the workspace from the middle of the base, in Haply's axes, where the service cannot put the origin
// there (3.1).
constexpr HaplyVector kWorkspaceMiddleM{0, -0.12, 0.15};

}  // namespace

/// One arm. The rhythm is: one command, one answer. While an answer is due no further command is sent, so that none can
/// queue up.
class Haply {
 public:
  static constexpr const char* kSummary = "Haply Inverse3, by way of Haply's local service";
  static constexpr const char* kOptions = "host=127.0.0.1 port=10001 device=ID key=auto|vector|values";

  Haply() = default;
  ~Haply() { let_go(); }
  Haply(const Haply&) = delete;
  Haply& operator=(const Haply&) = delete;

  Fault open(Options& options);
  Fault describe(mechane_device_info& info) const;
  Fault read(mechane_device_state& state);
  Fault write(const mechane_device_force& force);

 private:
  Fault choose_key(std::size_t choice);
  Fault take_inventory(const std::string& wanted);
  Fault start();
  Fault send(const HaplyVector& force_n);
  Fault take_answers(milliseconds patience);
  Fault take(std::string_view message);
  Fault judge_force();
  void let_go() noexcept;

  std::string where_;  // "the Haply service at 127.0.0.1:10001"
  std::optional<HaplyLink> link_;
  HaplyKey key_ = HaplyKey::vector;
  HaplyFrame frame_;
  HaplyForceWatch watch_;
  std::string command_;
  bool answer_due_ = false;
  bool started_ = false;
  int malformed_ = 0;
  Clock::time_point last_state_;
};

Fault Haply::open(Options& options) {
  const std::string host = options.text("host", "127.0.0.1");
  const auto port = static_cast<std::uint16_t>(options.number("port", 10001, 1, 65535));
  const std::string wanted = options.text("device", "");
  const std::size_t key = options.choice("key", {"auto", "vector", "values"});
  if (!options.fault().empty()) return options.fault();
  if (!wanted.empty() && !is_haply_id(wanted))
    return "the option device=" + wanted + " is not the id of an arm; an id looks like 049D";
  where_ = "the Haply service at " + host + ":" + std::to_string(port);
  command_.reserve(512);
  link_.emplace(host, port);
  if (Fault fault = choose_key(key); !fault.empty()) return fault;
  if (Fault fault = link_->open(); !fault.empty()) return fault;
  if (Fault fault = take_inventory(wanted); !fault.empty()) return fault;
  return start();
}

Fault Haply::choose_key(std::size_t choice) {
  if (choice != 0) {
    key_ = choice == 1 ? HaplyKey::vector : HaplyKey::values;
    return {};
  }
  std::string body;
  if (Fault fault = link_->ask_version(body); !fault.empty()) return fault;
  const auto version = parse_haply_version(body);
  if (!version) return where_ + " does not report its version; give the option key=values (3.1) or key=vector (3.5)";
  if (*version < std::pair(3, 1))
    return where_ + " has version " + std::to_string(version->first) + "." + std::to_string(version->second) +
           ", which speaks another format; install 3.1 or later";
  key_ = *version < std::pair(3, 5) ? HaplyKey::values : HaplyKey::vector;
  return {};
}

Fault Haply::take_inventory(const std::string& wanted) {
  std::string_view message;
  if (Fault fault = link_->receive(kOpening, message); !fault.empty()) return fault;
  if (message.empty()) return where_ + " does not say which devices there are; restart it";
  const HaplyParse parse = parse_haply(message, wanted, frame_);
  if (parse.kind == HaplyMessage::malformed)
    return where_ + " sent a first message that cannot be used: " + parse.why + "; is it version 3.1 or later?";
  if (parse.kind == HaplyMessage::no_device)
    return "no Inverse3 " + (wanted.empty() ? "" : wanted + " ") + "at " + where_ +
           "; there are: " + haply_devices(message) + "; check its USB cable and power, and the option device";
  if (frame_.basis != "XYZ")
    return where_ + " permutes the axes (" + frame_.basis +
           "); set the basis of the arm back to XYZ in Haply's settings";
  return {};
}

Fault Haply::start() {
  last_state_ = Clock::now();
  for (int tick = 0; tick < kOpeningTicks; ++tick) {
    if (tick == 0 && key_ == HaplyKey::vector) {
      write_haply_greeting(command_, frame_.device_id);
      if (Fault fault = link_->send(command_); !fault.empty()) return fault;
      answer_due_ = true;
    } else if (Fault fault = send({}); !fault.empty()) {
      return fault;
    }
    if (Fault fault = take_answers(kOpening); !fault.empty()) return fault;
    if (answer_due_) return where_ + " does not answer; restart it";
  }
  if (malformed_ > 0) return where_ + " sends messages that cannot be used; is it version 3.1 or later?";
  started_ = true;
  return {};
}

Fault Haply::describe(mechane_device_info& info) const {
  std::snprintf(info.name, sizeof info.name, "Haply Inverse3 %s", frame_.device_id.c_str());
  info.hand = MECHANE_HAND_POINT;
  info.output = MECHANE_OUTPUT_FORCE;
  info.peak_force_n = kPeakForceN;
  info.continuous_force_n = kContinuousForceN;
  info.max_stiffness_n_per_m = kStiffnessNPerM;
  info.max_damping_ns_per_m = kDampingNsPerM;
  info.rate_hz = kRateHz;
  for (int axis = 0; axis < 3; ++axis) {
    info.workspace_min_m[axis] = -kWorkspaceRadiusM;
    info.workspace_max_m[axis] = kWorkspaceRadiusM;
  }
  return {};
}

Fault Haply::read(mechane_device_state& state) {
  if (!answer_due_)  // no write() since the last read(): the service still answers only a command
    if (Fault fault = send({}); !fault.empty()) return fault;
  if (Fault fault = take_answers(kAnswer); !fault.empty()) return fault;
  if (Clock::now() - last_state_ > kSilence)
    return where_ + " has sent no state of arm " + frame_.device_id +
           " for a second; restart it, and look whether the computer is busy";
  HaplyVector position_m = frame_.cursor_position_m;
  if (key_ == HaplyKey::values)
    for (std::size_t axis = 0; axis < position_m.size(); ++axis)
      position_m[axis] -= kWorkspaceMiddleM[axis];
  position_m = haply_to_d(position_m);
  const auto& grip = frame_.grip_wxyz;
  const HaplyVector turn = haply_to_d({grip[1], grip[2], grip[3]});  // the axis turns as any vector does
  state.orientation_wxyz[0] = grip[0];
  for (std::size_t axis = 0; axis < position_m.size(); ++axis) {
    state.position_m[axis] = position_m[axis];
    state.orientation_wxyz[axis + 1] = turn[axis];
  }
  state.buttons = frame_.grip_buttons;
  if (!frame_.calibrated) state.flags |= MECHANE_STATE_UNCALIBRATED;
  if (frame_.ready && Clock::now() - last_state_ <= kFresh) state.flags |= MECHANE_STATE_READY;
  return {};
}

Fault Haply::write(const mechane_device_force& force) {
  // What came since read(): a message too many would put all later answers one command behind.
  if (Fault fault = take_answers(milliseconds(0)); !fault.empty()) return fault;
  // The service has not taken the last command yet, and a newer one would wait behind it.
  if (answer_due_) return {};
  return send(d_to_haply(limited(force.force_n, kPeakForceN)));
}

Fault Haply::send(const HaplyVector& force_n) {
  write_haply_force(command_, frame_.device_id, key_, force_n);
  if (Fault fault = link_->send(command_); !fault.empty()) return fault;
  watch_.asked(force_n);
  answer_due_ = true;
  return {};
}

/// Waits for one message, and then takes what else has come already, so that messages too many do not pile up.
Fault Haply::take_answers(milliseconds patience) {
  for (int i = 0; i < kMessagesAtOnce; ++i) {
    std::string_view message;
    if (Fault fault = link_->receive(i == 0 ? patience : milliseconds(0), message); !fault.empty()) return fault;
    if (message.empty()) return {};
    if (Fault fault = take(message); !fault.empty()) return fault;
  }
  return {};
}

Fault Haply::take(std::string_view message) {
  answer_due_ = false;
  const HaplyParse parse = parse_haply(message, frame_.device_id, frame_);
  switch (parse.kind) {
    case HaplyMessage::malformed:
      if (++malformed_ < kMalformedInARow) return {};
      return where_ + " sent " + std::to_string(malformed_) + " messages in a row that cannot be used: " + parse.why +
             "; restart it";
    case HaplyMessage::no_device:
      return "arm " + frame_.device_id + " is gone from " + where_ + "; check its USB cable and power";
    case HaplyMessage::state:
      break;
  }
  malformed_ = 0;
  last_state_ = Clock::now();
  return judge_force();
}

Fault Haply::judge_force() {
  switch (watch_.rendered(frame_.cursor_force_n)) {
    case HaplyForceWatch::Verdict::added:
      return "another program puts a force on arm " + frame_.device_id + " by way of " + where_ +
             "; close it (Haply Hub lists the sessions)";
    case HaplyForceWatch::Verdict::ignored:
      return where_ +
             " renders no force at all; give the option key=" + (key_ == HaplyKey::values ? "vector" : "values");
    case HaplyForceWatch::Verdict::fine:
      break;
  }
  return {};
}

/// Sends a last command without force: the service may take a while to notice that this client is gone.
void Haply::let_go() noexcept {
  if (!started_) return;
  try {
    (void)send({});
  } catch (const std::exception&) {  // out of memory: the connection ends now, and the force with it
  }
}

}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::Haply)
