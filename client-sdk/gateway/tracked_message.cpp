#include "client-sdk/gateway/tracked_message.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace mechane::gateway {
namespace {

constexpr std::uint8_t kTrackedMessage = 2;
constexpr std::uint8_t kTrackedVersion = 1;
constexpr const char* kFollowStream = "send what STREAM.md says";

/// Little-endian numbers one after another. Past the end all are 0, and ended() tells so.
class TrackedBytes {
 public:
  explicit TrackedBytes(std::span<const std::byte> bytes) : rest_(bytes) {}
  [[nodiscard]] std::uint8_t u8() {
    if (short_ || rest_.empty()) return short_ = true, std::uint8_t{0};
    const auto value = std::to_integer<std::uint8_t>(rest_.front());
    rest_ = rest_.subspan(1);
    return value;
  }
  [[nodiscard]] double f32() {
    std::uint32_t bits = 0;
    for (int shift = 0; shift < 32; shift += 8)
      bits |= std::uint32_t{u8()} << shift;
    return std::bit_cast<float>(bits);
  }
  [[nodiscard]] drivers::HandPoint point() {
    const double x = f32(), y = f32(), z = f32();
    return {x, y, z};
  }
  [[nodiscard]] bool ended_early() const { return short_; }
  [[nodiscard]] bool has_more() const { return !rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool short_ = false;
};

bool is_near(const drivers::HandPoint& p) {
  for (const double part : p)
    if (!(std::abs(part) <= hand::kFarthestHand_m)) return false;  // nor is NaN
  return true;
}

/// False: a joint is not a place in the world.
bool read_joints(TrackedBytes& bytes, TrackedHand& hand) {
  std::array<drivers::HandPoint, kXrJoints> joints;
  bool near = true;
  for (drivers::HandPoint& joint : joints) {
    joint = bytes.point();
    near = near && is_near(joint);
  }
  hand.points[0] = joints[0];
  // Fingers have a joint within the palm, and the thumb has not.
  for (std::size_t f = 0; f < hand::kFingers; ++f)
    for (std::size_t k = 0; k < drivers::kJointsOfFinger; ++k)
      hand.points[drivers::point_of(f, k)] = joints[drivers::point_of(f, k) + f];
  return near;
}

bool read_controller(TrackedBytes& bytes, TrackedHand& hand) {
  const drivers::HandPoint p = bytes.point();
  const double x = bytes.f32(), y = bytes.f32(), z = bytes.f32(), w = bytes.f32();
  const Quat turn(w, x, y, z);
  if (!is_near(p) || (hand.tracked && !(std::abs(turn.norm() - 1) < 0.01))) return false;
  hand.X_WH.p = Vec3(p[0], p[1], p[2]);
  if (hand.tracked) hand.X_WH.R = turn.normalized();
  return std::isfinite(x + y + z + w);
}

/// What is wrong with it; null: nothing.
const char* read_tracked_hand(TrackedBytes& bytes, TrackedHand& hand) {
  const std::uint8_t side = bytes.u8(), kind = bytes.u8(), tracked = bytes.u8();
  (void)bytes.u8();
  if (!hand::is_hand_side(side)) return "side";
  if (!hand::is_hand_kind(kind)) return "kind";
  hand.side = static_cast<hand::HandSide>(side);
  hand.kind = static_cast<hand::HandKind>(kind);
  hand.tracked = tracked != 0;
  const double closed = bytes.f32();
  if (!(closed >= -1 && closed <= 1)) return "closed";
  if (closed >= 0) hand.closed = closed;
  const bool right = hand.kind == hand::HandKind::glove ? read_joints(bytes, hand) : read_controller(bytes, hand);
  return right ? nullptr : "joints";
}

}  // namespace

Expected<std::vector<TrackedHand>> parse_tracked_message(std::span<const std::byte> bytes) {
  TrackedBytes in(bytes);
  const std::uint8_t type = in.u8(), version = in.u8(), count = in.u8();
  (void)in.u8();
  if (type != kTrackedMessage || version != kTrackedVersion || count > kMostTrackedHands)
    return fail(ErrorCode::damaged, "a binary message is not of tracked hands", {}, kFollowStream);
  std::vector<TrackedHand> hands(count);
  for (TrackedHand& hand : hands)
    if (const char* const wrong = read_tracked_hand(in, hand); wrong != nullptr && !in.ended_early())
      return fail(ErrorCode::invalid_value, "a tracked hand has a number that is wrong", wrong, kFollowStream);
  if (in.ended_early() || in.has_more())
    return fail(ErrorCode::damaged, "a message of tracked hands has another length than its hands need", {},
                kFollowStream);
  if (hands.size() == 2 && hands[0].side == hands[1].side)
    return fail(ErrorCode::invalid_value, "a message has the same hand twice", "side", kFollowStream);
  return hands;
}

}  // namespace mechane::gateway
