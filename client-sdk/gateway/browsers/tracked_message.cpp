#include "client-sdk/gateway/browsers/tracked_message.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

#include "server/base/byte_order.hpp"

namespace mechane::gateway {
namespace {

constexpr std::uint8_t kTrackedMessage = 2;
constexpr std::uint8_t kTrackedVersion = 1;
constexpr const char* kFollowStream = "send what STREAM.md says";

double f32(ByteSource& bytes) {
  return std::bit_cast<float>(bytes.get<std::uint32_t>());
}

drivers::HandPoint point_in(ByteSource& bytes) {
  const double x = f32(bytes), y = f32(bytes), z = f32(bytes);
  return {x, y, z};
}

bool is_near(const drivers::HandPoint& p) {
  for (const double part : p)
    if (!(std::abs(part) <= hand::kFarthestHand_m)) return false;  // nor is NaN
  return true;
}

/// False: a joint is not a place in the world.
bool read_joints(ByteSource& bytes, TrackedHand& hand) {
  std::array<drivers::HandPoint, kXrJoints> joints;
  bool near = true;
  for (drivers::HandPoint& joint : joints) {
    joint = point_in(bytes);
    near = near && is_near(joint);
  }
  hand.points[0] = joints[0];
  // Fingers have a joint within the palm, and the thumb has not.
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    for (std::size_t k = 0; k < drivers::kJointsOfFinger; ++k)
      hand.points[drivers::point_of(f, k)] = joints[drivers::point_of(f, k) + f];
  return near;
}

bool read_controller(ByteSource& bytes, TrackedHand& hand) {
  const drivers::HandPoint p = point_in(bytes);
  const double x = f32(bytes), y = f32(bytes), z = f32(bytes), w = f32(bytes);
  const Quat turn(w, x, y, z);
  if (!is_near(p) || (hand.tracked && !(std::abs(turn.norm() - 1) < 0.01))) return false;
  hand.X_WH.p = Vec3(p[0], p[1], p[2]);
  if (hand.tracked) hand.X_WH.R = turn.normalized();
  return std::isfinite(x + y + z + w);
}

/// What is wrong with it; null: nothing.
const char* read_tracked_hand(ByteSource& bytes, TrackedHand& hand) {
  const std::uint8_t side = bytes.get<std::uint8_t>(), kind = bytes.get<std::uint8_t>(),
                     tracked = bytes.get<std::uint8_t>();
  (void)bytes.get<std::uint8_t>();
  if (!hand::is_hand_side(side)) return "side";
  if (!hand::is_hand_kind(kind)) return "kind";
  hand.side = static_cast<hand::HandSide>(side);
  hand.kind = static_cast<hand::HandKind>(kind);
  hand.tracked = tracked != 0;
  const double closed = f32(bytes);
  if (!(closed >= -1 && closed <= 1)) return "closed";
  if (closed >= 0) hand.closed = closed;
  const bool right = hand.kind == hand::HandKind::glove ? read_joints(bytes, hand) : read_controller(bytes, hand);
  return right ? nullptr : "joints";
}

}  // namespace

Expected<std::vector<TrackedHand>> parse_tracked_message(std::span<const std::byte> bytes) {
  ByteSource in(bytes);
  const std::uint8_t type = in.get<std::uint8_t>(), version = in.get<std::uint8_t>(), count = in.get<std::uint8_t>();
  (void)in.get<std::uint8_t>();
  if (type != kTrackedMessage || version != kTrackedVersion || count > kMostTrackedHands)
    return fail(ErrorCode::damaged, "a binary message is not of tracked hands", {}, kFollowStream);
  std::vector<TrackedHand> hands(count);
  for (TrackedHand& hand : hands)
    if (const char* const wrong = read_tracked_hand(in, hand); wrong != nullptr && in.ok())
      return fail(ErrorCode::invalid_value, "a tracked hand has a number that is wrong", wrong, kFollowStream);
  if (!in.ok() || in.remaining() > 0)
    return fail(ErrorCode::damaged, "a message of tracked hands has another length than its hands need", {},
                kFollowStream);
  if (hands.size() == 2 && hands[0].side == hands[1].side)
    return fail(ErrorCode::invalid_value, "a message has the same hand twice", "side", kFollowStream);
  return hands;
}

}  // namespace mechane::gateway
