#include "server/transport/kiosk_link.hpp"

#include <algorithm>
#include <chrono>

#include "server/base/clock.hpp"
#include "server/realtime/priority.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::transport {
namespace {

std::uint32_t to_us(Duration d) noexcept {
  return static_cast<std::uint32_t>(std::clamp<std::int64_t>(d.count() / 1000, 0, 0xffffffff));
}

void set_contact(proto::WireLocalContact& out, const hand::LocalContact& from) noexcept {
  proto::set_vec3(out.p_W, from.p_W);
  proto::set_vec3(out.n_W, from.n_W);
  proto::set_vec3(out.v_W, from.v_W);
  out.depth_m = static_cast<float>(from.depth_m);
  out.curvature_per_m = static_cast<float>(from.curvature_per_m);
  out.stiffness_n_per_m = static_cast<float>(from.stiffness_n_per_m);
  out.damping_ns_per_m = static_cast<float>(from.damping_ns_per_m);
  out.static_friction = static_cast<float>(from.static_friction);
  out.dynamic_friction = static_cast<float>(from.dynamic_friction);
  out.viscosity_ns_per_m = static_cast<float>(from.viscosity_ns_per_m);
  out.groove_depth_m = static_cast<float>(from.grooves.depth_m);
  proto::set_vec3(out.groove_wave_W, from.grooves.wave_W);
  out.groove_phase_rad = static_cast<float>(from.grooves.phase_rad);
  out.valid_us = to_us(from.validity);
}

void set_held(proto::WireHeldPath& out, const hand::HeldPath& from) noexcept {
  out.kind = static_cast<std::uint8_t>(from.kind);
  proto::set_vec3(out.p_HG, from.p_HG);
  proto::set_vec3(out.p_W, from.p_W);
  proto::set_vec3(out.axis_W, from.axis_W);
  out.radius_m = static_cast<float>(from.radius_m);
  out.along_n = static_cast<float>(from.along_n);
  out.stiffness_n_per_m = static_cast<float>(from.stiffness_n_per_m);
  out.damping_ns_per_m = static_cast<float>(from.damping_ns_per_m);
  out.limit_n = static_cast<float>(from.limit_n);
  out.valid_us = to_us(from.validity);
}

void set_force(proto::HapticOutput& out, const hand::HapticOutput& from) noexcept {
  out.echo_seq = from.echo_sequence;
  out.echo_sent_ns = from.echo_sent_ns;
  out.reasons = from.reasons;
  proto::set_vec3(out.f_W, from.force_W.f);
  proto::set_vec3(out.t_W, from.force_W.t);
  for (std::size_t i = 0; i < from.finger_force_n.size(); ++i) {
    out.finger_force_n[i] = static_cast<float>(from.finger_force_n[i]);
  }
  out.holding = from.holding ? 1 : 0;
  out.clicks = from.clicks.count;
  out.click_n = static_cast<float>(from.clicks.strength_n);
  set_held(out.held, from.held);
  out.contact_count = from.contact_count;
  for (std::size_t i = 0; i < hand::kMaxLocalContacts; ++i) {
    set_contact(out.contacts[i], i < out.contact_count ? from.contacts[i] : hand::LocalContact{});
  }
}

}  // namespace

Expected<std::shared_ptr<KioskLink>> KioskLink::create(const proto::Participant& participant, const std::string& kiosk,
                                                       std::uint64_t epoch, RejectCounters& rejects,
                                                       int fifo_priority) {
  std::shared_ptr<KioskLink> link(new KioskLink(kiosk, epoch, rejects, fifo_priority));
  const std::string partition = proto::kiosk_partition(kiosk);
  auto writer = proto::Writer<proto::HapticOutput>::create(participant, partition);
  if (!writer) return tl::unexpected<Error>(writer.error());
  link->writer_ = std::move(*writer);
  KioskLink* const raw = link.get();  // the reader is a member of the link, and ends before it
  auto reader = proto::Reader<proto::HapticInput>::create(
      participant, partition, [raw](proto::ReaderView<proto::HapticInput> view) { raw->take(view); });
  if (!reader) return tl::unexpected<Error>(reader.error());
  link->reader_ = std::move(*reader);
  return link;
}

void KioskLink::open(const std::shared_ptr<HandChannel>& channel) {
  const std::lock_guard lock(mutex_);
  hands_[channel->user].channel = channel;
}

void KioskLink::close(const std::shared_ptr<HandChannel>& channel) {
  const std::lock_guard lock(mutex_);
  if (hands_[channel->user].channel == channel) hands_[channel->user].channel.reset();
}

void KioskLink::shut() {
  reader_ = {};
}

void KioskLink::take(proto::ReaderView<proto::HapticInput> view) noexcept {
  // This is the network's receive thread. At ordinary priority, samples would wait while a display draws.
  realtime::take_fifo_once(fifo_priority_);
  proto::HapticInput wire;
  proto::SampleInfo info;
  while (view.take_into(wire, info)) {
    if (info.valid) rejects_.add(accept(wire, std::chrono::steady_clock::now()));
  }
}

/// An echo of another epoch tells nothing of the delay; it counts as none.
Reject KioskLink::check_delay(const proto::HapticInput& wire, TimePoint now) const noexcept {
  const std::optional<Duration> round_trip = hands_[wire.user].sent.round_trip_of(
      wire.echo_epoch == epoch_ ? wire.echo_seq : 0, std::chrono::microseconds(wire.echo_held_us), now);
  if (!round_trip) return Reject::bad_value;
  return *round_trip > kTooLate ? Reject::too_late : Reject::none;
}

Reject KioskLink::accept(const proto::HapticInput& wire, TimePoint now) noexcept {
  if (const Reject fault = validate(wire, arriving_.sample); fault != Reject::none) return fault;
  if (proto::text_of(wire.kiosk) != kiosk_) return Reject::wrong_kiosk;
  Hand& hand = hands_[wire.user];
  if (hand.owner.load(std::memory_order_relaxed) != wire.session) return Reject::wrong_session;
  if (const Reject fault = check_delay(wire, now); fault != Reject::none) return fault;
  hand.heard_ns.store(now.time_since_epoch().count(), std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  if (!hand.channel || hand.channel->session != wire.session) return Reject::none;  // its world is still being made
  const hand::SampleOrder order = hand.channel->order.offer(wire.session, wire.seq, now);
  if (order == hand::SampleOrder::older) return Reject::old_sequence;
  if (order == hand::SampleOrder::too_high) return Reject::high_sequence;
  hand.channel->deadband_share.store(static_cast<double>(wire.deadband), std::memory_order_relaxed);
  arriving_.arrived = now;
  hand.channel->inputs.publish(arriving_);
  return Reject::none;
}

bool KioskLink::write(const HandChannel& channel, const OutgoingForce& force) noexcept {
  proto::set_text(wire_.kiosk, kiosk_);
  wire_.user = channel.user;
  wire_.protocol = proto::kProtocol;
  wire_.session = channel.session;
  wire_.seq = hands_[channel.user].next_sequence++;
  hands_[channel.user].sent.note(wire_.seq, std::chrono::steady_clock::now());
  wire_.tick = force.tick;
  wire_.waited_us = to_us(force.waited);
  wire_.epoch = epoch_;
  set_force(wire_, force.output);
  wire_.sent_ns = to_ns(std::chrono::steady_clock::now());
  return writer_.write(wire_);
}

}  // namespace mechane::transport
