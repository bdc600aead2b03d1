#include "server/hand/governor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

namespace mechane::hand {
namespace {

HandForce nothing(std::uint32_t reasons) {
  HandForce zero;
  zero.reasons = reasons;
  return zero;
}

bool all_finite(const GovernorInput& in) {
  const bool vectors = in.wanted_W.f.allFinite() && in.wanted_W.t.allFinite() && in.weight_W.f.allFinite() &&
                       in.weight_W.t.allFinite() && in.V_WH.v.allFinite() && in.V_WH.w.allFinite();
  return vectors &&
         std::all_of(in.finger_force_n.begin(), in.finger_force_n.end(), [](double f) { return std::isfinite(f); });
}

// Scales v to the limit when it is longer; true when it was. stableNorm: a wild input of 1e300 N must not overflow into a NaN.
bool clamp_norm(Vec3& v, double limit) {
  const double norm = v.stableNorm();
  if (!(norm > limit)) return false;
  v = (v / norm) * limit;
  return true;
}

// Moves `value` towards `target` by at most `step`; true when that fell short.
bool approach(Vec3& value, const Vec3& target, double step) {
  Vec3 change = target - value;
  const bool limited = clamp_norm(change, step);
  value = limited ? Vec3(value + change) : target;
  return limited;
}

bool approach(double& value, double target, double step) {
  const bool limited = std::abs(target - value) > step;
  value = limited ? value + std::copysign(step, target - value) : target;
  return limited;
}

/// What of a force is a weight: no more than there is of it, along it.
Vec3 weight_in(const Vec3& force, const Vec3& weight) {
  const double size = weight.stableNorm();
  if (!(size > 0)) return Vec3::Zero();
  const Vec3 along = weight / size;
  return std::clamp(force.dot(along), 0.0, size) * along;
}

Wrench weight_in(const Wrench& force, const Wrench& weight, double gain) {
  return {weight_in(force.f, gain * weight.f), weight_in(force.t, gain * weight.t)};
}

Wrench operator-(const Wrench& a, const Wrench& b) {
  return {a.f - b.f, a.t - b.t};
}

bool is_zero(const Wrench& wrench) {
  return wrench.f.isZero(0) && wrench.t.isZero(0);
}

double work_j(const Wrench& force, const Twist& V_WH, double dt_s) {
  return (force.f.dot(V_WH.v) + force.t.dot(V_WH.w)) * dt_s;
}

/// No force is on the hand, and none is wanted.
bool is_free(const GovernorState& state, const GovernorInput& in) {
  return !in.touching && in.wanted_W.f.isZero(0) && in.wanted_W.t.isZero(0) && state.last.force_W.f.isZero(0) &&
         state.last.force_W.t.isZero(0);
}

bool in_range(double value, double low, double high) {
  return std::isfinite(value) && value >= low && value <= high;
}

/// Checks what goes out: only numbers within the limits leave here, and the state is ready for the next call.
HandForce finish(GovernorState& state, HandForce out) noexcept {
  for (std::size_t i = 0; i < kReasonCount; ++i) {
    if ((out.reasons & (1u << i)) != 0) ++state.counts[i];
  }
  // Arithmetic on finite but absurd inputs may still overflow.
  const bool sane = out.force_W.f.allFinite() && out.force_W.t.allFinite();
  if (!sane) {
    out = nothing(out.reasons | kNotFinite);
    state.ramp = state.gain = 0;
    ++state.counts[std::countr_zero(static_cast<std::uint32_t>(kNotFinite))];
    state.credit_j = std::min(state.credit_j, 0.0);
    if (!std::isfinite(state.credit_j)) state.credit_j = 0;
    state.lifted_j = 0;
  }
  state.last = out;
  return out;
}

Expected<void> check(const GovernorConfig& c) {
  struct Range {
    const char* name;
    double value, low, high;
  };
  const Range ranges[] = {
      {"max_force_n", c.max_force_n, 0, 100},
      {"max_torque_nm", c.max_torque_nm, 0, 10},
      {"max_finger_force_n", c.max_finger_force_n, 0, 40},
      {"max_slew_n_per_s", c.max_slew_n_per_s, 1e-3, 1e6},
      {"max_torque_slew_nm_per_s", c.max_torque_slew_nm_per_s, 1e-3, 1e6},
      {"max_finger_slew_n_per_s", c.max_finger_slew_n_per_s, 1e-3, 1e6},
      {"ramp_up_s", c.ramp_up_s, 0, 10},
      {"ramp_down_s", c.ramp_down_s, 0, 10},
      {"energy_margin_j", c.energy_margin_j, 0, 1},
      {"energy_credit_j", c.energy_credit_j, c.energy_margin_j, 100},
      {"max_damping_ns_per_m", c.max_damping_ns_per_m, 0, 1000},
  };
  for (const Range& r : ranges) {
    if (in_range(r.value, r.low, r.high)) continue;
    char what[64], remedy[64];
    std::snprintf(what, sizeof(what), "%s is %g", r.name, r.value);
    std::snprintf(remedy, sizeof(remedy), "give a value from %g to %g", r.low, r.high);
    return fail(ErrorCode::invalid_value, what, "force governor", remedy);
  }
  if (c.hold < Duration{0} || c.zero_by <= c.hold) {
    return fail(ErrorCode::conflict, "hold is negative, or zero_by is not above hold", "force governor",
                "use 10 ms for hold and 50 ms for zero_by");
  }
  return {};
}

}  // namespace

Expected<ForceGovernor> ForceGovernor::make(const GovernorConfig& config) {
  if (auto checked = check(config); !checked) return tl::unexpected(checked.error());
  return ForceGovernor(config);
}

GovernorState ForceGovernor::start() const noexcept {
  GovernorState state;
  state.credit_j = config_.energy_margin_j;
  return state;
}

void ForceGovernor::reset(GovernorState& state) const noexcept {
  const auto counts = state.counts;
  state = start();
  state.counts = counts;
}

HandForce ForceGovernor::apply(GovernorState& state, const GovernorInput& input, Duration dt) const noexcept {
  const double dt_s = to_seconds(std::max(dt, Duration{0}));
  const double step_s = std::min(dt_s, to_seconds(kLongestStep));
  std::uint32_t reasons = kNone;
  const double gain_before = state.gain;
  state.gain = next_gain(state, input, dt_s, reasons);
  if (!all_finite(input)) {
    state.ramp = state.gain = 0;
    return finish(state, nothing(reasons | kNotFinite));
  }
  const Wrench weight_before = weight_in(state.last.force_W, input.weight_W, gain_before);
  const Wrench last = state.last.force_W - weight_before;
  settle_energy(state, last, input, work_j(weight_before, input.V_WH, dt_s), dt_s);
  if (config_.strict_energy && is_free(state, input))
    state.credit_j = std::min(state.credit_j, config_.energy_margin_j);

  Wrench wanted = input.wanted_W;
  bool clamped = clamp_norm(wanted.f, config_.max_force_n);
  clamped |= clamp_norm(wanted.t, config_.max_torque_nm);

  // The force on the device falls with the gain at once; the slew limit holds from there on.
  const double fall = state.gain < gain_before ? state.gain / gain_before : 1.0;
  HandForce out = state.last;
  out.force_W.f *= fall;
  out.force_W.t *= fall;
  bool limited = approach(out.force_W.f, state.gain * wanted.f, config_.max_slew_n_per_s * step_s);
  limited |= approach(out.force_W.t, state.gain * wanted.t, config_.max_torque_slew_nm_per_s * step_s);
  for (std::size_t i = 0; i < kFingers; ++i) {
    const double finger = std::clamp(input.finger_force_n[i], 0.0, config_.max_finger_force_n);
    clamped |= finger != input.finger_force_n[i];
    out.finger_force_n[i] *= fall;
    limited |= approach(out.finger_force_n[i], state.gain * finger, config_.max_finger_slew_n_per_s * step_s);
  }
  if (clamped) reasons |= kClamped;
  if (limited) reasons |= kSlewLimited;
  if (config_.passivity && state.gain > 0) {
    const Wrench weight = weight_in(out.force_W, input.weight_W, state.gain);
    const double most_n = out.force_W.f.norm(), most_nm = out.force_W.t.norm();
    out.force_W = out.force_W - weight;
    keep_passive(state, last, input.V_WH, dt_s, out.force_W, reasons);
    if (!is_zero(weight)) {
      out.force_W = {out.force_W.f + weight.f, out.force_W.t + weight.t};
      // What was taken away may have borne a part of the weight.
      clamp_norm(out.force_W.f, most_n);
      clamp_norm(out.force_W.t, most_nm);
    }
  }
  out.reasons = reasons;
  return finish(state, out);
}

double ForceGovernor::next_gain(GovernorState& state, const GovernorInput& input, double dt_s,
                                std::uint32_t& reasons) const noexcept {
  const double target = input.engaged ? 1.0 : 0.0;
  const double ramp_time = input.engaged ? config_.ramp_up_s : config_.ramp_down_s;
  if (state.ramp != target) {
    reasons |= kRamping;
    const bool waits = input.engaged && input.touching;
    const double step_s = input.engaged ? std::min(dt_s, to_seconds(kLongestStep)) : dt_s;
    if (!waits) approach(state.ramp, target, ramp_time > 0 ? step_s / ramp_time : 1.0);
  }
  const double fresh = freshness(input.age, config_.hold, config_.zero_by);
  if (fresh < 1.0) reasons |= kStale;
  if (fresh <= 0) state.ramp = 0;
  return fresh * state.ramp;
}

// The force of the last call acted while the hand moved to where it is now: its work is taken from the credit (a hand that works
// against the force adds to it).
void ForceGovernor::settle_energy(GovernorState& state, const Wrench& last, const GovernorInput& input,
                                  double by_weight_j, double dt_s) const noexcept {
  constexpr double kDeepest_j = 1e3;  // no hand sinks so far
  const double most_j = config_.energy_credit_j;
  state.credit_j = std::min(state.credit_j - work_j(last, input.V_WH, dt_s), most_j);
  if (!is_zero(input.weight_W)) {
    state.lifted_j = std::clamp(state.lifted_j - by_weight_j, -kDeepest_j, most_j);
    if (!std::isfinite(state.lifted_j)) state.lifted_j = 0;
  } else if (state.lifted_j != 0) {  // it has been put down
    state.credit_j = std::min(state.credit_j + std::max(state.lifted_j, 0.0), most_j);
    state.lifted_j = 0;
  }
  // A velocity that is finite but absurd (1e300 m/s) must not spoil the account for good.
  state.credit_j = std::max(state.credit_j, -config_.energy_credit_j - config_.energy_margin_j);
}

void ForceGovernor::keep_passive(const GovernorState& state, const Wrench& last, const Twist& V_WH, double dt_s,
                                 Wrench& force, std::uint32_t& reasons) const noexcept {
  if (dt_s <= 0) return;
  const double credit_j = state.credit_j + std::max(state.lifted_j, 0.0);
  if (config_.strict_energy && credit_j <= 0 && force.f.dot(V_WH.v) + force.t.dot(V_WH.w) >= 0) {
    bool held_back = clamp_norm(force.f, last.f.norm());
    held_back |= clamp_norm(force.t, last.t.norm());
    if (held_back) reasons |= kDamped;
  }
  const double power_f = force.f.dot(V_WH.v);
  const double power_t = force.t.dot(V_WH.w);
  const double excess = power_f + power_t - credit_j / dt_s;  // watts over what the account can pay in this step
  if (excess <= 0) return;
  reasons |= kDamped;
  const double positive = std::max(power_f, 0.0) + std::max(power_t, 0.0);
  // First take away what pushes the hand along its own motion: this only shrinks the force.
  if (positive > 0) {
    const double share = std::min(excess / positive, 1.0);
    if (power_f > 0) force.f -= share * (power_f / V_WH.v.squaredNorm()) * V_WH.v;
    if (power_t > 0) force.t -= share * (power_t / V_WH.w.squaredNorm()) * V_WH.w;
  }
  // Then, where the account is overdrawn, damp: within the device's limits and the slew limit.
  const double overdrawn = excess - positive;
  const double speed_squared = V_WH.v.squaredNorm();
  if (overdrawn <= 0 || speed_squared <= 0) return;
  const double step_n = config_.max_slew_n_per_s * std::min(dt_s, to_seconds(kLongestStep));
  Vec3 damping = -std::min(overdrawn / speed_squared, config_.max_damping_ns_per_m) * V_WH.v;
  clamp_norm(damping, step_n);
  if (config_.strict_energy) {  // the damping has no step of its own
    const double most_n = std::max(step_n, (force.f - last.f).norm());
    Vec3 change = force.f + damping - last.f;
    clamp_norm(change, most_n);
    force.f = last.f + change;
  } else {
    force.f += damping;  // a server's journals were recorded with a step for the damping
  }
  clamp_norm(force.f, config_.max_force_n * state.gain);
}

std::uint64_t GovernorState::count(ForceReason reason) const noexcept {
  const auto bits = static_cast<std::uint32_t>(reason);
  if (!std::has_single_bit(bits) || std::countr_zero(bits) >= static_cast<int>(kReasonCount)) return 0;
  return counts[static_cast<std::size_t>(std::countr_zero(bits))];
}

}  // namespace mechane::hand
