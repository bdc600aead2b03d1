// ForceGovernor: the limits on every force that reaches a hand. The server runs one for its users; the client runs another, which has
// the last word.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "server/base/clock.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/hand/freshness.hpp"
#include "server/hand/hand_force.hpp"

namespace mechane::hand {

struct GovernorConfig {
  double max_force_n = 3.0;          ///< of the device, continuous; range 0 .. 100
  double max_torque_nm = 0.2;        ///< range 0 .. 10; 0 for a device without torque
  double max_finger_force_n = 12.0;  ///< CyberGrasp's own limit; range 0 .. 40
  double max_slew_n_per_s = 1000;    ///< how fast the force may change; over 0
  double max_torque_slew_nm_per_s = 60;
  double max_finger_slew_n_per_s = 2000;
  Duration hold = kHoldFor;          ///< a sample counts in full up to this age
  Duration zero_by = kZeroBy;        ///< all forces are exactly zero from this age on
  double ramp_up_s = 0.5;            ///< at the start of a visit; 0 .. 10
  double ramp_down_s = 0.1;          ///< at its end; 0 .. 10
  bool passivity = true;             ///< the energy observer
  double energy_margin_j = 0.002;    ///< what the hand may be given before it has put anything in
  double energy_credit_j = 0.5;      ///< the energy that it has put in is remembered up to this; above the margin
  bool strict_energy = false;        ///< on a device: see ForceGovernor
  double max_damping_ns_per_m = 10;  ///< the most that the observer adds
};

/// The force that is wanted, and what is known of the hand. All in W, SI.
struct GovernorInput {
  Wrench wanted_W;                                ///< force and torque on the visitor's hand
  Wrench weight_W;                                ///< what of it is the weight of a body that the hand carries
  std::array<double, kFingers> finger_force_n{};  ///< each >= 0
  Twist V_WH;                                     ///< of the hand where `wanted_W` acts: its mean since the last call
  Duration age{0};                                ///< of the last new sample, on our own clock
  bool engaged = true;                            ///< a visit is on; the governor ramps when this changes
  bool touching = false;                          ///< the hand is in contact: a ramp up goes on when it no longer is
};

/// What a governor remembers of one hand between two calls. Plain data, so that its owner can keep it with its other state: a world in
/// its WorldState, a client beside its device. ForceGovernor::start() makes one; a default-constructed one has no energy margin.
struct GovernorState {
  HandForce last;   ///< what is on the device now
  double ramp = 0;  ///< 0 .. 1
  double gain = 0;  ///< of the last call: freshness times ramp
  /// What the hand has put in and not yet got back, plus the margin. Below zero: the observer is damping.
  double credit_j = 0;
  /// What the hand has put into the weight that it carries, by lifting; below zero where it has sunk. Pays for other forces, too.
  double lifted_j = 0;
  std::array<std::uint64_t, kReasonCount> counts{};  ///< how many calls had each reason, by bit

  /// `reason` is one bit.
  [[nodiscard]] std::uint64_t count(ForceReason reason) const noexcept;
};

/// The rules for one hand, as functions of a configuration and a state. In this order: a number that is not finite
/// makes everything zero at once; force and torque are clamped as vectors, keeping their direction; the gain (freshness
/// of the sample times the ramp of the visit) scales them; the slew limit holds their change; the energy observer takes
/// away what the system would give out beyond what it was given, and damps.
///
/// The slew limit never delays a safety drop: when the gain falls, what is on the device now falls with it, at once,
/// and the limit holds for what remains; a fall of the gain to zero is a force of exactly zero. Upwards the limit
/// always holds, also after a drop. A force that was lost, because a sample was too old or a number not finite, is
/// ramped up again from zero. No ramp goes up while the hand is in contact: a wall that hardens around a hand puts
/// energy into it that it never gave, and shakes.
///
/// The energy observer is the time-domain passivity control of Hannaford and Ryu (2002), eqs. (3)-(5), with three
/// departures: the credit is capped (else an hour's friction would pay for any later push); removing the force's own
/// part along the motion, which can only shrink it, has no limit, while added damping has one; force and torque share
/// one account. A weight has an account of its own, which may be overdrawn: as in life, it gives a hand that sinks what no
/// hand had put in. With `strict_energy` the credit is forgotten when the hand is free, and while the account is overdrawn
/// no force rises on a hand that does not move against it: else a force that is cut as soon as the hand yields, and
/// comes back as soon as it rests, would shake the hand, and give it a little energy each time. Nor does damping then add to the step that
/// the slew limit allows.
///
/// Any thread, each with states of its own; no allocation; the same inputs give the same bits.
class ForceGovernor {
 public:
  /// Errors name the setting that is out of range.
  [[nodiscard]] static Expected<ForceGovernor> make(const GovernorConfig& config);

  /// The longest time that slew and ramp are counted for in one call: a loop that was held up does not make up for it in one step.
  static constexpr Duration kLongestStep = std::chrono::milliseconds(2);

  /// A hand that was not there before: no force, a ramp to come.
  [[nodiscard]] GovernorState start() const noexcept;
  /// The force for the next `dt`; call at the device's rate. `dt` <= 0 allows no rise.
  [[nodiscard]] HandForce apply(GovernorState& state, const GovernorInput& input, Duration dt) const noexcept;
  /// Back to the start; the counts stay.
  void reset(GovernorState& state) const noexcept;

  [[nodiscard]] const GovernorConfig& config() const noexcept { return config_; }

 private:
  explicit ForceGovernor(const GovernorConfig& config) : config_(config) {}

  [[nodiscard]] double next_gain(GovernorState& state, const GovernorInput& input, double dt_s,
                                 std::uint32_t& reasons) const noexcept;
  /// `last`: what was on the hand, without the weight, which gave the hand `by_weight_j`.
  void settle_energy(GovernorState& state, const Wrench& last, const GovernorInput& input, double by_weight_j,
                     double dt_s) const noexcept;
  /// `last`, `force`: without the weight.
  void keep_passive(const GovernorState& state, const Wrench& last, const Twist& V_WH, double dt_s, Wrench& force,
                    std::uint32_t& reasons) const noexcept;

  GovernorConfig config_;
};

}  // namespace mechane::hand
