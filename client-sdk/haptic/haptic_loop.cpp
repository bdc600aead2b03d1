#include "client-sdk/haptic/haptic_loop.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "server/hand/held_path.hpp"

namespace mechane::haptic {
namespace {

// A hand may be off a path already when it first hears of it: the server's force goes over into the path's in this time.
constexpr double kPathComesInS = 0.1;

}  // namespace

using client::ForceSample;
using hand::HandSample;

Expected<std::unique_ptr<HapticLoop>> HapticLoop::create(client::Client& client, Device& device, RenderMode mode,
                                                         double deadband) {
  if (auto opened = device.open(); !opened) return tl::unexpected(opened.error());
  hand::GovernorConfig limits = device.limits();
  limits.zero_by = kZeroBy;
  limits.strict_energy = true;
  limits.energy_margin_j = std::min(limits.energy_margin_j, kEnergyMargin_j);
  auto governor = hand::ForceGovernor::make(limits);
  if (!governor) {
    device.close();
    return tl::unexpected(governor.error());
  }
  return std::unique_ptr<HapticLoop>(new HapticLoop(client, device, mode, *governor, deadband));
}

HapticLoop::~HapticLoop() {
  device_.write({});
  device_.close();
}

void HapticLoop::send(const HandSample& input, TimePoint now) noexcept {
  if (deadband_.is_on()) {
    const double reach_m = hand::reach_m(answer_, sent(answer_.echo_sequence).p_WH, input.X_WH.p);
    if (!deadband_.is_due(input, reach_m, now)) return;
  }
  if (!client_.send(input)) return;
  ++stats_.sent;
  sent_[client_.sent_sequence() % sent_.size()] = {input.X_WH.p, now};
  if (deadband_.is_on()) deadband_.note_sent(input, now);
}

bool HapticLoop::take_answer() noexcept {
  const std::optional<ForceSample> sample = client_.newest_force();
  if (!sample || sample->echo_sequence > client_.sent_sequence()) return false;  // nobody can answer what was not sent
  const std::uint64_t echo = sample->echo_sequence;
  const Duration delay = echo > 0 ? sample->received - sent(echo).at : Duration{0};
  if (client_.sent_sequence() - echo >= sent_.size() || delay > kTooLate) {
    ++stats_.too_late;
    return false;
  }
  const hand::SampleOrder order = age_.offer(client_.session(), echo, sample->received);
  if (order != hand::SampleOrder::newer && echo != answer_.echo_sequence) return false;
  answer_ = *sample;
  ++stats_.answers;
  click_.hear(answer_.clicks);
  // The time for which a deadband held an answer back is no delay of the network. It is kKeepAlive at most: the rest is a late server.
  const Duration most_held_back = deadband_.is_on() ? hand::kKeepAlive : Duration{0};
  const Duration held_back = std::clamp(answer_.waited - kTickPeriod, Duration{0}, most_held_back);
  if (order == hand::SampleOrder::newer && echo > 0) note_delay(std::max(delay - held_back, Duration{0}));
  return true;
}

void HapticLoop::note_delay(Duration delay) noexcept {
  round_trip_.record(delay);
  delay_ = std::max(delay, delay_ - (delay_ - delay) / 256);
}

/// A spring that is closed over a delay t is stable up to a stiffness of (b + B) / (T / 2 + t), with b and B the damping of hand and
/// spring (Gil et al. 2009): so what the server computes is lowered in that proportion.
double HapticLoop::stiffness_share() const noexcept {
  constexpr double kHalfTick_s = 0.5 * kTickSeconds;
  return std::min(1.0, (kHalfTick_s + to_seconds(kFullDelay)) / (kHalfTick_s + to_seconds(delay_)));
}

void HapticLoop::set_local_contacts() noexcept {
  local_.set(answer_.contact_span(), sent(answer_.echo_sequence).p_WH);
}

/// The hand's mean velocity since the last call. The energy that a force gave is found from places: a device's own velocity is late.
Twist HapticLoop::moved(const HandSample& input, Duration dt) noexcept {
  const Pose before = std::exchange(X_WH_before_, input.X_WH).value_or(input.X_WH);
  return dt > Duration{0} ? mean_twist(before, input.X_WH, to_seconds(dt)) : Twist{};
}

void HapticLoop::render(const HandSample& input, TimePoint now, Duration dt, bool engaged) noexcept {
  const Duration age = age_.age(now);
  // A force that returns is ramped up from zero, as at the start of a visit: after a silence of the server, and after
  // this loop itself stood still, when an old answer may still be in its socket and look new.
  const Duration too_long = governor_.config().zero_by;
  const bool ready = device_.condition() == DeviceCondition::ready;
  const bool stood_still = dt >= too_long;
  if (age >= too_long || stood_still || !ready) {
    governor_.reset(governed_);
    click_.forget();
  }
  hand::GovernorInput wanted;
  const double share = stiffness_share();
  wanted.wanted_W = {share * answer_.force_W.f, share * answer_.force_W.t};
  std::transform(answer_.finger_force_n.begin(), answer_.finger_force_n.end(), wanted.finger_force_n.begin(),
                 [share](double force_n) { return share * force_n; });
  wanted.touching = answer_.touches();
  wanted.weight_W = hand::held_weight(answer_.held, input.X_WH, age);
  const auto kind_before = std::exchange(path_kind_, answer_.held.kind);
  const bool on_path = path_kind_ != hand::HeldPath::Kind::none;
  path_share_ = on_path && path_kind_ == kind_before ? std::min(1.0, path_share_ + to_seconds(dt) / kPathComesInS) : 0;
  if (mode_ == RenderMode::local && path_kind_ == hand::HeldPath::Kind::free) {
    const double left_out = path_share_ * (1 - share);
    wanted.wanted_W.f += left_out * wanted.weight_W.f;
    wanted.wanted_W.t += left_out * wanted.weight_W.t;
  } else if (mode_ == RenderMode::local && (on_path || !answer_.holding)) {
    const Vec3 touch = local_.render(input.X_WH.p, input.V_WH.v, age);
    // What is held does not count: else a force that was lost would not come back before the visitor lets go.
    wanted.touching = wanted.touching || !touch.isZero(0);
    const Vec3 path = hand::held_path_force(answer_.held, input.X_WH, input.V_WH, age, share);
    const double here = on_path ? path_share_ : 1;
    wanted.wanted_W.f = here * (touch + path) + (1 - here) * wanted.wanted_W.f;
  }
  wanted.wanted_W.f += click_.render(dt);
  const bool warm = heat_.limit(wanted.wanted_W.f);
  wanted.V_WH = moved(input, dt);
  wanted.age = age;
  wanted.engaged = engaged && ready;
  rendered_ = governor_.apply(governed_, wanted, stood_still ? Duration{0} : dt);
  heat_.rendered(rendered_.force_W.f.norm(), dt);
  if (warm) rendered_.reasons |= kWarm;
  if (!ready) rendered_.reasons |= kNotReady;
  device_.write(rendered_);
  state_.store(state_for_visitors(device_.condition(), heat_.lowered(), renders_), std::memory_order_relaxed);
}

void HapticLoop::tick(TimePoint now, Duration dt) noexcept {
  const HandSample& input = hand_ = device_.read(dt);
  if (device_.condition() != DeviceCondition::lost) send(input, now);
  if (take_answer() && mode_ == RenderMode::local) set_local_contacts();
  render(input, now, dt, client_.state() == client::LinkState::joined);
  ++stats_.ticks;
  if (age_.known() && age_.age(now) >= governor_.config().zero_by) ++stats_.silent_ticks;
  if (answer_.holding) ++stats_.holding_ticks;
  if ((rendered_.reasons & kWarm) != 0) ++stats_.warm_ticks;
  const double force_n = rendered_.force_W.f.norm();
  if (force_n <= 0) return;
  ++stats_.ticks_with_force;
  stats_.force_sum_n += force_n;
  stats_.force_max_n = std::max(stats_.force_max_n, force_n);
}

void HapticLoop::begin_anew() noexcept {
  governor_.reset(governed_);
  click_.forget();
  X_WH_before_.reset();
}

bool HapticLoop::release(TimePoint now, Duration dt) noexcept {
  const HandSample input = device_.read(dt);
  render(input, now, dt, false);
  return rendered_.force_W.f.isZero(0) && rendered_.force_W.t.isZero(0);
}

}  // namespace mechane::haptic
