#include "client-sdk/haptic/haptic_loop.hpp"

#include <algorithm>
#include <optional>

namespace mechane::haptic {

using client::ForceSample;
using hand::HandSample;

Expected<std::unique_ptr<HapticLoop>> HapticLoop::create(client::Client& client, Device& device, RenderMode mode) {
  auto governor = hand::ForceGovernor::make(device.limits());
  if (!governor) return tl::unexpected(governor.error());
  if (auto opened = device.open(); !opened) return tl::unexpected(opened.error());
  return std::unique_ptr<HapticLoop>(new HapticLoop(client, device, mode, *governor));
}

HapticLoop::~HapticLoop() {
  device_.write({});
  device_.close();
}

bool HapticLoop::take_answer() noexcept {
  const std::optional<ForceSample> sample = client_.newest_force();
  if (!sample || sample->echo_sequence > client_.sent_sequence()) return false;  // nobody can answer what was not sent
  const hand::SampleOrder order = age_.offer(client_.session(), sample->echo_sequence, sample->received);
  if (order != hand::SampleOrder::newer && sample->echo_sequence != answer_.echo_sequence) return false;
  answer_ = *sample;
  ++stats_.answers;
  if (order == hand::SampleOrder::newer && answer_.echo_sequence > 0)
    round_trip_.record(answer_.received - answer_.echo_sent());
  return true;
}

void HapticLoop::set_local_contacts() noexcept {
  // Of an older sample we no longer know where the hand was.
  if (client_.sent_sequence() - answer_.echo_sequence >= sent_p_WH_.size()) return local_.clear();
  local_.set(answer_.contact_span(), sent_p_WH_[answer_.echo_sequence % sent_p_WH_.size()]);
}

void HapticLoop::render(const HandSample& input, TimePoint now, Duration dt, bool engaged) noexcept {
  const Duration age = age_.age(now);
  // A force that returns is ramped up from zero, as at the start of a visit: after a silence of the server, and after
  // this loop itself stood still, when an old answer may still be in its socket and look new.
  const Duration too_long = governor_.config().zero_by;
  if (age >= too_long || dt >= too_long) governor_.reset(governed_);
  hand::GovernorInput wanted;
  wanted.wanted_W = answer_.force_W;
  wanted.finger_force_n = answer_.finger_force_n;
  if (mode_ == RenderMode::local && !answer_.holding)
    wanted.wanted_W.f = local_.render(input.X_WH.p, input.V_WH.v, age);
  wanted.V_WH = input.V_WH;
  wanted.age = age;
  wanted.engaged = engaged;
  wanted.touching = answer_.contact_count > 0;
  rendered_ = governor_.apply(governed_, wanted, dt);
  device_.write(rendered_);
}

void HapticLoop::tick(TimePoint now, Duration dt) noexcept {
  const HandSample input = device_.read(dt);
  if (client_.send(input)) {
    ++stats_.sent;
    sent_p_WH_[client_.sent_sequence() % sent_p_WH_.size()] = input.X_WH.p;
  }
  if (take_answer() && mode_ == RenderMode::local) set_local_contacts();
  render(input, now, dt, client_.state() == client::LinkState::joined);
  ++stats_.ticks;
  if (age_.known() && age_.age(now) >= governor_.config().zero_by) ++stats_.silent_ticks;
  if (answer_.holding) ++stats_.holding_ticks;
  const double force_n = rendered_.force_W.f.norm();
  if (force_n <= 0) return;
  ++stats_.ticks_with_force;
  stats_.force_sum_n += force_n;
  stats_.force_max_n = std::max(stats_.force_max_n, force_n);
}

bool HapticLoop::release(TimePoint now, Duration dt) noexcept {
  const HandSample input = device_.read(dt);
  render(input, now, dt, false);
  return rendered_.force_W.f.isZero(0) && rendered_.force_W.t.isZero(0);
}

}  // namespace mechane::haptic
