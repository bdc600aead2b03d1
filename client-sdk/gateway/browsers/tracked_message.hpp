// The hands that a headset sees, as a browser sends them: a binary message, STREAM.md has the form.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "client-sdk/drivers/joints/hand_datagram.hpp"
#include "server/base/error.hpp"
#include "server/base/math.hpp"
#include "server/hand/hand_sample.hpp"

namespace mechane::gateway {

/// One hand of a visitor in a headset, as its tracker sees it at this moment; all places are in W.
struct TrackedHand {
  hand::HandSide side = hand::HandSide::right;
  /// A whole hand of joints, or a controller, which is one point.
  hand::HandKind kind = hand::HandKind::glove;
  bool tracked = false;            ///< false: all that follows means nothing
  std::optional<double> closed{};  ///< 0 open .. 1 closed: a pinch, or the controller's trigger
  drivers::HandPoints points{};    ///< of a whole hand, metres
  Pose X_WH;                       ///< of a controller's tip
};

inline constexpr std::size_t kMostTrackedHands = 2;
inline constexpr std::size_t kXrJoints = 25;  ///< of an XRHand, in the order of WebXR Hand Input

/// Errors: damaged (another kind, version or length), invalid_value (a number that is not finite, or farther than kFarthestHand_m from W's
/// origin; a side or kind that there is not). Both hands of a message have different sides. An empty message: the headset was taken off.
[[nodiscard]] Expected<std::vector<TrackedHand>> parse_tracked_message(std::span<const std::byte> bytes);

}  // namespace mechane::gateway
