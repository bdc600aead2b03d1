// A recorded hand, as if somebody did the same again: for tests, for showing, and to try a setting twice with one movement.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

#include "client-sdk/drivers/driver_class.hpp"
#include "client-sdk/drivers/playback/recording.hpp"

namespace mechane::drivers {
namespace {

class Playback {
 public:
  static constexpr const char* kSummary =
      "plays a hand that 'mechane haptic --record FILE' has recorded; needs no device";
  static constexpr const char* kOptions = "file=FILE speed=NUMBER from=SECONDS loop=no|yes";

  Fault open(Options& options) {
    file_ = options.text("file", "");
    speed_ = options.number("speed", 1, 0.01, 100);
    from_s_ = options.number("from", 0, 0, 1e6);
    loop_ = options.choice("loop", {"no", "yes"}) == 1;
    if (!options.fault().empty()) return options.fault();
    std::ifstream in(file_, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    if (!in || !text) return "cannot read the recording '" + file_ + "'; give it as file=FILE";
    if (const Fault wrong = recording_.take_text(text.str()); !wrong.empty())
      return "the recording " + file_ + " is not right: " + wrong;
    if (from_s_ > recording_.length_s())
      return "the recording " + file_ + " ends before the option from=" + std::to_string(from_s_);
    begun_ = Clock::now();
    return {};
  }

  Fault describe(mechane_device_info& info) {
    std::snprintf(info.name, sizeof info.name, "A recorded hand");
    info.hand = recording_.is_glove ? MECHANE_HAND_GLOVE : MECHANE_HAND_POINT;
    info.side = recording_.is_left ? MECHANE_HAND_LEFT : MECHANE_HAND_RIGHT;
    info.output = MECHANE_OUTPUT_NONE;
    info.rate_hz = 1000;
    return {};
  }

  Fault read(mechane_device_state& state) {
    double t_s = from_s_ + speed_ * std::chrono::duration<double>(Clock::now() - begun_).count();
    if (loop_ && recording_.length_s() > 0) t_s = std::fmod(t_s, recording_.length_s());
    state = recording_.at(t_s);
    state.flags = MECHANE_STATE_READY;
    return {};
  }

  Fault write(const mechane_device_force&) { return {}; }

 private:
  using Clock = std::chrono::steady_clock;
  std::string file_;
  double speed_ = 1;
  double from_s_ = 0;
  bool loop_ = false;
  HandRecording recording_;
  Clock::time_point begun_;
};

}  // namespace
}  // namespace mechane::drivers

MECHANE_EXPORT_DRIVER(mechane::drivers::Playback)
