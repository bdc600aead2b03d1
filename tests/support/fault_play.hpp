// A client's haptic loop, on a simulated clock and a simulated stylus, through everything that can fail around it; what it writes to the
// device is held against the limits.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::test {

/// What goes wrong while a hand presses.
enum class Fault {
  server_dies,      ///< no answer any more
  server_stops,     ///< the same, and afterwards all answers that it owes at once
  uplink_dead,      ///< answers go on, but none is to a sample of now; also: every sample is rejected
  long_queue,       ///< answers come half a second late
  loop_stops,       ///< no tick for a while: SIGSTOP, or a clock that jumps
  not_a_number,     ///< in every tenth answer
  absurd_sequence,  ///< echoes of samples that were never sent, up to 2^64 - 1
  device_lost,      ///< the cable is out
  device_let_go,    ///< the dead-man's switch
};
inline constexpr int kFaults = 9;

/// What was written, all in all.
struct FaultFindings {
  std::uint64_t ticks = 0;
  std::uint64_t over_limit = 0;  ///< forces over the device's limit, or not finite
  std::uint64_t over_slew = 0;   ///< steps upwards over the slew limit, or downwards over it without a reason
  std::uint64_t over_ramp = 0;   ///< forces that came back after a fault faster than the ramp of a visit's start
  std::uint64_t faults = 0;
  std::uint64_t pressed = 0;  ///< faults while there was a force
  std::uint64_t answers = 0;  ///< that the server sent
  double zero_ms_max = 0;     ///< from the fault to a force of zero, for all faults but single numbers
};

/// A stylus that can be lost or let go.
class FaultyStylus final : public haptic::Device {
 public:
  explicit FaultyStylus(const haptic::StylusConfig& config) : stylus(config, Vec3(0, 0.01, 0)) {}
  haptic::SimulatedStylus stylus;
  haptic::DeviceCondition now = haptic::DeviceCondition::ready;
  hand::HandForce written;

  [[nodiscard]] Expected<void> open() override { return {}; }
  void close() noexcept override {}
  [[nodiscard]] client::HandSample read(Duration dt) noexcept override { return stylus.read(dt); }
  void write(const hand::HandForce& force) noexcept override { stylus.write(written = force); }
  [[nodiscard]] haptic::DeviceCondition condition() const noexcept override { return now; }
  [[nodiscard]] hand::GovernorConfig limits() const override { return {}; }
};

class FaultPlay {
 public:
  /// `deadband`: the share by which both sides leave messages out.
  FaultPlay(haptic::RenderMode mode, unsigned seed, double deadband = 0) : share_(deadband), random_(seed) {
    auto made = haptic::HapticLoop::create(client_, device_, mode, deadband);
    if (!made) throw std::runtime_error(made.error().to_string());
    loop_ = std::move(*made);
  }

  /// Presses and lifts at random, with a fault now and then, for so many ticks.
  const FaultFindings& play(std::uint64_t ticks) {
    const std::uint64_t end = found_.ticks + ticks;
    while (found_.ticks < end) {
      for (int i = pick(200, 2500); i > 0; --i)
        tick(kTickPeriod);
      begin(static_cast<Fault>(pick(0, kFaults - 1)));
      for (int i = pick(1, 800); i > 0; --i)
        tick(kTickPeriod);
      fault_.reset();
      device_.now = haptic::DeviceCondition::ready;
    }
    return found_;
  }

 private:
  int pick(int least, int most) { return std::uniform_int_distribution<>(least, most)(random_); }

  void begin(Fault fault) {
    fault_ = fault;
    ++found_.faults;
    began_ = now_;
    zero_since_ = device_.written.force_W.f.norm() == 0;
    if (!zero_since_) ++found_.pressed;
    stuck_echo_ = client_.sent_sequence();
    owed_ = 0;
    if (fault == Fault::loop_stops) {
      // Meanwhile the driver's process renders zero: see driver_process_test.cpp. Here the time begins with the loop.
      const auto stop = std::chrono::milliseconds(pick(50, 3000));
      began_ += stop - kTickPeriod;
      tick(stop);
    }
    if (fault == Fault::device_lost) device_.now = haptic::DeviceCondition::lost;
    if (fault == Fault::device_let_go) device_.now = haptic::DeviceCondition::not_ready;
  }

  void tick(Duration dt) {
    now_ += dt;
    ++found_.ticks;
    if (--until_turn_ <= 0) {
      until_turn_ = pick(50, 1500);
      aim_m_ = pick(0, 3) == 0 ? 0.01 : -0.001 * pick(0, 20);
      holds_ = pick(0, 2) == 0;
      carries_ = pick(0, 1) == 0;
    }
    y_m_ += std::clamp(aim_m_ - y_m_, -2e-4, 2e-4);
    device_.stylus.intend(Vec3(0, y_m_, 0));
    answer();
    leave_out();
    const hand::HandForce before = device_.written;
    loop_->tick(now_, dt);
    judge(before, device_.written, dt);
  }

  /// What arrives before this tick.
  void answer() {
    client_.answer_with_floor(kFloor_n_per_m, now_);
    client::ForceSample& sample = *client_.arrived;
    sample.contacts[0].dynamic_friction = 0.5;
    sample.contacts[0].viscosity_ns_per_m = hand::kMaxViscosity_ns_per_m;
    const Vec3 wave(800, 0, 0);
    sample.contacts[0].grooves = {.depth_m = 3e-4, .wave_W = wave, .phase_rad = wave.dot(client_.hand.X_WH.p)};
    sample.clicks = {static_cast<std::uint32_t>(found_.ticks / 97), 0.8};
    if (holds_) {  // a handle at y = 0 on a slider along z, or a body of 2 N
      sample.holding = true;
      sample.contact_count = 0;
      sample.held = {.kind = hand::HeldPath::Kind::line,
                     .axis_W = Vec3::UnitZ(),
                     .along_n = 0.5,
                     .stiffness_n_per_m = kFloor_n_per_m,
                     .damping_ns_per_m = 1,
                     .limit_n = 6};
      if (carries_) sample.held = {.kind = hand::HeldPath::Kind::free, .axis_W = -Vec3::UnitY(), .along_n = 2};
    }
    if (!fault_) return;
    switch (*fault_) {
      case Fault::server_dies:
      case Fault::server_stops:
        // All answers that are owed at once: only the newest is seen, and it answers an old sample.
        if (*fault_ == Fault::server_dies || ++owed_ % 300 != 0) return client_.arrived.reset();
        sample.echo_sequence -= std::min<std::uint64_t>(sample.echo_sequence, 299);
        break;
      case Fault::uplink_dead:
        sample.echo_sequence = stuck_echo_;
        break;
      case Fault::long_queue:
        sample.echo_sequence -= std::min<std::uint64_t>(sample.echo_sequence, 500);
        break;
      case Fault::not_a_number:
        if (pick(0, 9) == 0)
          sample.force_W.f.x() = sample.contacts[0].depth_m = sample.held.along_n =
              std::numeric_limits<double>::quiet_NaN();
        break;
      case Fault::absurd_sequence:
        sample.echo_sequence =
            pick(0, 1) == 0 ? std::numeric_limits<std::uint64_t>::max() : sample.echo_sequence + pick(2, 9);
        break;
      case Fault::loop_stops:
      case Fault::device_lost:
      case Fault::device_let_go:
        break;
    }
  }

  /// What a server with a deadband does not send.
  void leave_out() {
    if (!client_.arrived) return;
    if (!deadband_.is_due(share_, *client_.arrived, client_.hand.X_WH.p, now_)) return client_.arrived.reset();
    deadband_.note_sent(*client_.arrived, client_.hand.X_WH.p, now_);
    ++found_.answers;
  }

  void judge(const hand::HandForce& before, const hand::HandForce& after, Duration dt) {
    const hand::GovernorConfig limits = device_.limits();
    const double force_n = after.force_W.f.norm(), rise_n = force_n - before.force_W.f.norm();
    const double step_n = limits.max_slew_n_per_s * to_seconds(std::min(dt, hand::ForceGovernor::kLongestStep)) + 1e-9;
    if (!(force_n <= limits.max_force_n * (1 + 1e-12))) ++found_.over_limit;
    if (rise_n > step_n || (rise_n < -step_n && after.reasons == 0)) ++found_.over_slew;
    const bool expected = fault_ && *fault_ != Fault::not_a_number;
    if (expected && !zero_since_ && force_n == 0) {
      zero_since_ = true;
      found_.zero_ms_max = std::max(found_.zero_ms_max, 1e3 * to_seconds(now_ - began_));
    }
    // A fault of some length has ended: from its end on the ramp has to start at zero.
    if (expected &&
        (*fault_ == Fault::loop_stops ? now_ - began_ < std::chrono::milliseconds(2) : now_ - began_ > silent_after_))
      ramp_from_ = now_;
    const double ramped = to_seconds(now_ - ramp_from_) / limits.ramp_up_s;
    if (ramped < 1 && force_n > limits.max_force_n * (ramped + 0.01)) ++found_.over_ramp;
  }

  static constexpr double kFloor_n_per_m = 600;
  double share_;
  hand::OutputDeadband deadband_;
  // With a deadband, the last answer from before a fault may come when the fault has begun.
  Duration silent_after_ = haptic::HapticLoop::kZeroBy + kTickPeriod + (share_ > 0 ? hand::kKeepAlive : Duration{0});
  ScriptedClient client_;
  FaultyStylus device_{{.hand = haptic::ArmConfig{}}};
  std::unique_ptr<haptic::HapticLoop> loop_;
  std::mt19937 random_;
  TimePoint now_{std::chrono::hours(1)};
  std::optional<Fault> fault_;
  TimePoint began_;
  TimePoint ramp_from_;
  bool zero_since_ = true;
  std::uint64_t stuck_echo_ = 0;
  std::uint64_t owed_ = 0;
  int until_turn_ = 0;
  double aim_m_ = 0.01;
  bool holds_ = false;
  bool carries_ = false;  // what is held hangs on nothing else
  double y_m_ = 0.01;
  FaultFindings found_;
};

}  // namespace mechane::test
