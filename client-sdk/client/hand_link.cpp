#include "client-sdk/client/hand_link.hpp"

#include <algorithm>
#include <chrono>

#include "client-sdk/client/parse.hpp"
#include "server/realtime/priority.hpp"
#include <mechane/proto/convert.hpp>

namespace mechane::client {
namespace {

constexpr std::uint64_t kLongestHeld_us = 1'000'000'000;

}  // namespace

HandLink::HandLink(const ClientConfig& config, std::uint64_t session)
    : kiosk_(config.kiosk), user_(config.user), session_(session), fifo_priority_(config.fifo_priority) {
  proto::set_text(sending_.kiosk, kiosk_);
  sending_.user = user_;
  sending_.protocol = proto::kProtocol;
  sending_.session = session;
  sending_.deadband = static_cast<float>(config.deadband);
}

Expected<std::unique_ptr<HandLink>> HandLink::create(const proto::Participant& participant, const ClientConfig& config,
                                                     std::uint64_t session) {
  std::unique_ptr<HandLink> made(new HandLink(config, session));
  const std::string partition = proto::kiosk_partition(config.kiosk);
  auto writer = proto::Writer<proto::HapticInput>::create(participant, partition);
  if (!writer) return tl::unexpected<Error>(writer.error());
  made->writer_ = std::move(*writer);
  HandLink* const raw = made.get();
  auto reader =
      proto::Reader<proto::HapticOutput>::create(participant, partition, [raw](auto v) { raw->take_forces(v); });
  if (!reader) return tl::unexpected<Error>(reader.error());
  made->reader_ = std::move(*reader);
  return made;
}

bool HandLink::send(const HandSample& input) noexcept {
  proto::HapticInput& s = sending_;
  s.seq = sent_.load(std::memory_order_relaxed) + 1;
  proto::set_pose(s.X_WH, input.X_WH);
  proto::set_vec3(s.v_WH, input.V_WH.v);
  proto::set_vec3(s.w_WH, input.V_WH.w);
  for (std::size_t i = 0; i < kHandJoints; ++i)
    s.joints[i] = static_cast<float>(input.joints[i]);
  s.hand_scale = static_cast<float>(input.hand_scale);
  for (std::size_t i = 0; i < kFingers; ++i)
    s.finger_scale[i] = static_cast<float>(input.finger_scale[i]);
  s.grasp_intent = static_cast<float>(input.grasp_intent);
  s.buttons = input.buttons;
  s.kind = static_cast<std::uint32_t>(input.kind);
  s.side = static_cast<std::uint32_t>(input.side);
  s.echo_epoch = heard_epoch_.load(std::memory_order_acquire);
  s.echo_seq = heard_seq_.load(std::memory_order_relaxed);
  const std::uint64_t heard_at_ns = heard_at_ns_.load(std::memory_order_relaxed);
  s.sent_ns = to_ns(std::chrono::steady_clock::now());
  s.echo_held_us =
      static_cast<std::uint32_t>(std::min<std::uint64_t>((s.sent_ns - heard_at_ns) / 1000, kLongestHeld_us));
  sent_.store(s.seq, std::memory_order_relaxed);
  return writer_.write(s);
}

void HandLink::take_forces(proto::ReaderView<proto::HapticOutput> view) noexcept {
  realtime::take_fifo_once(fifo_priority_);
  proto::HapticOutput wire;
  proto::SampleInfo info;
  while (view.take_into(wire, info)) {
    const std::uint64_t epoch = epoch_.load(std::memory_order_relaxed);
    if (!info.valid || wire.user != user_ || wire.session != session_ || epoch == 0 || wire.epoch != epoch) continue;
    if (!parse(wire, arriving_)) continue;
    arriving_.received = std::chrono::steady_clock::now();
    if (order_.offer(wire.epoch, wire.seq, arriving_.received) != hand::SampleOrder::newer) continue;
    arriving_.sequence = ++taken_;
    heard_at_ns_.store(to_ns(arriving_.received), std::memory_order_relaxed);
    heard_seq_.store(wire.seq, std::memory_order_relaxed);
    heard_epoch_.store(wire.epoch, std::memory_order_release);
    forces_.publish(arriving_);
    arrived_.signal();
  }
}

std::optional<ForceSample> HandLink::newest_force() noexcept {
  const ForceSample* force = forces_.take();
  return force == nullptr ? std::nullopt : std::optional<ForceSample>(*force);
}

std::optional<ForceSample> HandLink::wait_force(Duration timeout) {
  const TimePoint deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    if (auto force = newest_force()) return force;
    const Duration left = deadline - std::chrono::steady_clock::now();
    if (left <= Duration{0}) return std::nullopt;
    arrived_.wait(left);
  }
}

}  // namespace mechane::client
