// The client's haptic loop: device in, network out, network in, governor, device out.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>

#include "client-sdk/haptic/click_pulse.hpp"
#include "client-sdk/haptic/device.hpp"
#include "client-sdk/haptic/heat_limit.hpp"
#include "server/hand/deadband.hpp"
#include "server/hand/freshness.hpp"
#include "server/hand/governor.hpp"
#include "server/hand/local_contact_model.hpp"
#include "server/realtime/histogram.hpp"
#include <mechane/client/client.hpp>

namespace mechane::haptic {

/// Which force the device renders.
enum class RenderMode {
  /// The server's force; for a LAN, where an answer is a millisecond old.
  server,
  /// Computed from the server's contacts, and the path of what is held, at the device's own rate, whatever the network.
  /// The server still computes torque, the forces on fingers, the force of a held object along its path, and the force of
  /// one that has no path, save for the weight of what is carried freely.
  local,
};

struct LoopStats {
  std::uint64_t ticks = 0;
  std::uint64_t sent = 0;
  std::uint64_t answers = 0;       ///< forces received and used
  std::uint64_t too_late = 0;      ///< forces dropped: they answer a sample that was sent too long ago
  std::uint64_t silent_ticks = 0;  ///< ticks since the first force whose newest force was too old to be rendered
  double force_max_n = 0;
  double force_sum_n = 0;  ///< over ticks with force
  std::uint64_t ticks_with_force = 0;
  std::uint64_t holding_ticks = 0;
  std::uint64_t warm_ticks = 0;  ///< the force was lowered to what the device bears for long
};

/// The haptic client's loop. One thread calls tick() at the device's rate (a PeriodicThread, or a device's own
/// callback). To stop, call release() until it returns true: the force is then exactly zero. When the loop goes, the
/// device is given zero whatever it rendered, and closed.
class HapticLoop {
 public:
  /// An answer that took longer, from sending the hand on, is dropped.
  static constexpr Duration kTooLate = std::chrono::milliseconds(100);
  /// The server's force is rendered in full up to this delay, and then with less stiffness.
  static constexpr Duration kFullDelay = std::chrono::milliseconds(5);

  /// The device's forces are zero from this age on, before the server's own.
  static constexpr Duration kZeroBy = std::chrono::milliseconds(40);
  /// What a hand may be given before it has put anything in.
  static constexpr double kEnergyMargin_j = 0.0005;

  /// Opens the device. `deadband`: hands that differ by no more than this share of what is felt are not sent, 0 to
  /// hand::kMaxDeadband, as in the client's own ClientConfig; 0: one is sent each tick. Errors: the device's own;
  /// its limits are not valid for a governor.
  [[nodiscard]] static Expected<std::unique_ptr<HapticLoop>> create(client::Client& client, Device& device,
                                                                    RenderMode mode, double deadband = 0);
  ~HapticLoop();
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  /// Reads the device, sends the hand, takes the newest force, limits it, writes it. Whatever fails, the device renders
  /// nothing later than 40 ms, on our own clock, after the last answer to a sample that had not been answered before:
  /// forces of a server that no longer hears this hand do not count. Nor does a device that is not ready render anything, and
  /// the hand of one that is lost is not sent. The next force is ramped up, once the hand has
  /// left what it was in contact with.
  void tick(TimePoint now, Duration dt) noexcept;
  /// Ramps the force down and out. True when the device renders exactly zero.
  [[nodiscard]] bool release(TimePoint now, Duration dt) noexcept;
  /// Before the first tick after a release(), where the hand may be somewhere else by now: the next force is ramped up as after a silence.
  void begin_anew() noexcept;

  [[nodiscard]] const LoopStats& stats() const noexcept { return stats_; }
  /// From sending a hand to receiving the force that answers it.
  [[nodiscard]] const realtime::LatencyHistogram& round_trip() const noexcept { return round_trip_; }
  [[nodiscard]] const hand::HandForce& rendered() const noexcept { return rendered_; }
  /// Where the hand was in the last tick.
  [[nodiscard]] const client::HandSample& hand() const noexcept { return hand_; }
  [[nodiscard]] bool holding() const noexcept { return answer_.holding; }
  /// The path of what it holds.
  [[nodiscard]] const hand::HeldPath& held() const noexcept { return answer_.held; }
  /// The hand overlaps something that it does not hold.
  [[nodiscard]] bool touches() const noexcept { return answer_.touches(); }
  /// The device after the last tick, for visitors. Any thread.
  [[nodiscard]] client::DeviceState device_state() const noexcept { return state_.load(std::memory_order_relaxed); }

 private:
  HapticLoop(client::Client& client, Device& device, RenderMode mode, const hand::ForceGovernor& governor,
             double deadband)
      : client_(client),
        device_(device),
        mode_(mode),
        deadband_(deadband),
        governor_(governor),
        governed_(governor.start()),
        heat_(device.limits().max_force_n, device.continuous_force_n()),
        renders_(device.renders()) {}
  void send(const client::HandSample& input, TimePoint now) noexcept;
  bool take_answer() noexcept;
  void note_delay(Duration delay) noexcept;
  [[nodiscard]] double stiffness_share() const noexcept;
  void set_local_contacts() noexcept;
  [[nodiscard]] Twist moved(const client::HandSample& input, Duration dt) noexcept;
  void render(const client::HandSample& input, TimePoint now, Duration dt, bool engaged) noexcept;

  client::Client& client_;
  Device& device_;
  RenderMode mode_;
  hand::InputDeadband deadband_;
  hand::ForceGovernor governor_;
  hand::GovernorState governed_;
  HeatLimit heat_;
  bool renders_;  // the device
  std::atomic<client::DeviceState> state_{client::DeviceState::preparing};
  hand::LocalContactModel local_;
  ClickPulse click_;
  hand::HeldPath::Kind path_kind_ = hand::HeldPath::Kind::none;
  double path_share_ = 0;  // of the held object's path or weight in the force
  hand::SampleAge age_;
  client::ForceSample answer_;
  client::HandSample hand_;
  /// What is known of a sample that was sent.
  struct Sent {
    Vec3 p_WH = Vec3::Zero();
    TimePoint at;
  };
  [[nodiscard]] const Sent& sent(std::uint64_t sequence) const noexcept { return sent_[sequence % sent_.size()]; }
  std::array<Sent, 1024> sent_{};    // by sequence number
  std::optional<Pose> X_WH_before_;  // in the last call
  Duration delay_{0};                // of the answers: rises at once, falls slowly
  hand::HandForce rendered_;
  LoopStats stats_;
  realtime::LatencyHistogram round_trip_;
};

}  // namespace mechane::haptic
