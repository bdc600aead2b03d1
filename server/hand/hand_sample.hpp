// A hand as its device sees it: what a client sends, what the wire carries, what a world moves. Declared here once; proto/hand.cpp
// compares the numbers of the wire's contract with these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "server/base/math.hpp"

namespace mechane::hand {

inline constexpr std::size_t kMaxUsers = 4;      ///< hands of one kiosk, and in one world
inline constexpr std::size_t kFingers = 5;       ///< thumb, index, middle, ring, little
inline constexpr std::size_t kFingerJoints = 4;  ///< of one finger: abduction, then flexion from the palm outwards
inline constexpr std::size_t kPhalanges = 3;     ///< of one finger, from the palm outwards
inline constexpr std::size_t kHandJoints = kFingers * kFingerJoints;
inline constexpr std::size_t kHandSegments = 1 + kFingers * kPhalanges;  ///< the palm, then each finger's phalanges

/// How a device shows the hand. A glove moves 16 segments; a one-point device (a stylus, a pointer) has one sphere at its tip.
enum class HandKind : std::uint8_t { one_point = 0, glove = 1 };
/// Whether a number from outside names a kind.
[[nodiscard]] constexpr bool is_hand_kind(std::uint64_t number) noexcept {
  return number <= static_cast<std::uint64_t>(HandKind::glove);
}

/// Which of a person's hands.
enum class HandSide : std::uint8_t { right = 0, left = 1 };
/// Whether a number from outside names a side.
[[nodiscard]] constexpr bool is_hand_side(std::uint64_t number) noexcept {
  return number <= static_cast<std::uint64_t>(HandSide::left);
}

[[nodiscard]] constexpr std::size_t segment_count(HandKind kind) noexcept {
  return kind == HandKind::glove ? kHandSegments : 1;
}
/// The finger's phalanx next to the palm, among the segments.
[[nodiscard]] constexpr std::size_t first_segment(std::size_t finger) noexcept {
  return 1 + kPhalanges * finger;
}
/// The finger that a segment belongs to. Not for the palm, which is segment 0.
[[nodiscard]] constexpr std::size_t finger_of(std::size_t segment) noexcept {
  return (segment - 1) / kPhalanges;
}
[[nodiscard]] constexpr bool is_fingertip(std::size_t segment) noexcept {
  return segment != 0 && segment % kPhalanges == 0;
}

inline constexpr double kFarthestHand_m = 100;  ///< from the world's origin: no visitor reaches so far
inline constexpr double kMinHandScale = 0.5;
inline constexpr double kMaxHandScale = 1.5;
inline constexpr double kMinFingerScale = 0.7;
inline constexpr double kMaxFingerScale = 1.4;

/// Which hand it is, and its size against that of the model, which is a grown person's middle-sized hand. A measure of a person's body.
struct HandBuild {
  HandSide side = HandSide::right;
  double hand_scale = 1.0;  ///< of palm and fingers, kMinHandScale .. kMaxHandScale
  /// The length of each finger against that of the model at hand_scale, kMinFingerScale .. kMaxFingerScale (glove).
  std::array<double, kFingers> finger_scale{1.0, 1.0, 1.0, 1.0, 1.0};

  /// How much longer this segment is than the model's.
  [[nodiscard]] constexpr double length_scale(std::size_t segment) const noexcept {
    return segment == 0 ? hand_scale : hand_scale * finger_scale[finger_of(segment)];
  }
  friend bool operator==(const HandBuild&, const HandBuild&) = default;
};

/// One sample of a device. What comes from the network is checked before it becomes one: all numbers finite, the rotation of unit length.
struct HandSample : HandBuild {
  HandKind kind = HandKind::one_point;
  Pose X_WH;                                 ///< wrist (glove) or tip (one-point) in W
  Twist V_WH;                                ///< its velocity, m/s and rad/s
  std::array<double, kHandJoints> joints{};  ///< by finger, kFingerJoints each, radians (glove)
  std::uint32_t buttons = 0;
  double grasp_intent = 0.0;  ///< 0 open .. 1 closed: a button, a pinch, or the glove's own estimate
};

/// A sample with what its sender wrote on it.
struct SentSample : HandSample {
  std::uint64_t session = 0;   ///< the sender: a client's own random number, never 0
  std::uint64_t sequence = 0;  ///< rises by one a sample within a session
  std::uint64_t sent_ns = 0;   ///< the sender's clock; echoed, never compared with ours
};

}  // namespace mechane::hand
