#include "client-sdk/gateway/http/frame_bytes.hpp"

#include <algorithm>
#include <bit>
#include <chrono>

#include "server/base/byte_order.hpp"

namespace mechane::gateway {
namespace {

constexpr std::uint8_t kFrameKind = 1;
constexpr std::uint8_t kFrameVersion = 1;

/// Of this machine's clock that never goes back.
std::uint16_t sent_at(TimePoint now) {
  using Tenths = std::chrono::duration<std::int64_t, std::ratio<1, 10'000>>;  // of a millisecond
  return static_cast<std::uint16_t>(std::chrono::duration_cast<Tenths>(now.time_since_epoch()).count());
}

template <class Sink>
void put_float(Sink& sink, double value) {
  put(sink, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

template <class Sink>
void put_pose(Sink& sink, const Pose& X) {
  for (const double value : {X.p.x(), X.p.y(), X.p.z(), X.R.x(), X.R.y(), X.R.z(), X.R.w()})
    put_float(sink, value);
}

void put_hand(VectorSink& sink, const client::HandPose& hand) {
  const bool one_point = hand.kind == client::HandKind::one_point;
  put(sink, static_cast<std::uint8_t>(hand.user));
  put(sink, static_cast<std::uint8_t>(one_point ? 0 : 1));
  put(sink, static_cast<std::uint8_t>(hand.stale));
  put(sink, static_cast<std::uint8_t>(hand.holding));
  for (const double value : {hand.force_W.x(), hand.force_W.y(), hand.force_W.z()})
    put_float(sink, value);
  const std::size_t segments = one_point ? 1 : hand.X_WS.size();
  put(sink, static_cast<std::uint32_t>(segments));
  for (std::size_t k = 0; k < segments; ++k)
    put_pose(sink, hand.X_WS[k]);
}

}  // namespace

FrameBody encode_frame(const client::Frame& frame) {
  FrameBody body{frame.sequence, frame.tick, frame.received, {}};
  body.bytes.reserve(64 + 36 * frame.bodies.size() + 4 * frame.quantities.size() + 512 * frame.hands.size());
  VectorSink sink(body.bytes);
  put(sink, static_cast<std::uint32_t>(frame.bodies.size()));
  put(sink, static_cast<std::uint32_t>(frame.quantities.size()));
  put(sink, static_cast<std::uint32_t>(frame.hands.size()));
  put(sink, static_cast<std::uint32_t>(frame.ropes.size()));
  for (const client::BodyPose& moving : frame.bodies) {
    const bool hidden = moving.object < frame.visible.size() && frame.visible[moving.object] == 0;
    put(sink, moving.object);
    put(sink, static_cast<std::uint32_t>(hidden ? 0 : 1));
    put_pose(sink, moving.X_WB);
  }
  for (const double quantity : frame.quantities)
    put_float(sink, quantity);
  for (const client::HandPose& hand : frame.hands)
    put_hand(sink, hand);
  for (const client::RopeShape& rope : frame.ropes) {
    put_float(sink, rope.diameter_m);
    put(sink, static_cast<std::uint32_t>(rope.points_W.size()));
    for (const Vec3& p : rope.points_W)
      for (const double value : {p.x(), p.y(), p.z()})
        put_float(sink, value);
  }
  return body;
}

std::array<std::byte, kFrameHeader> frame_header(const FrameBody& frame, std::uint32_t skipped, TimePoint now) {
  std::array<std::byte, kFrameHeader> bytes{};
  SpanSink sink(bytes);
  put(sink, kFrameKind);
  put(sink, kFrameVersion);
  put(sink, sent_at(now));
  put(sink, skipped);
  put(sink, frame.sequence);
  put(sink, frame.tick);
  put(sink, std::bit_cast<std::uint64_t>(to_seconds(now - frame.received)));
  return bytes;
}

}  // namespace mechane::gateway
