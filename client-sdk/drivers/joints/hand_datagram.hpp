// A hand as a tracking program sends it: a JSON object a datagram, with the joints of OpenXR, WebXR or MediaPipe.
//   {"format": "openxr", "hand": "left", "joints": [[x, y, z], ...], "tracked": true, "seq": 7, "pinch": 0.5}
// The joints are in metres, in the tracker's frame and in the order of the format:
//   openxr     26 joints of XR_EXT_hand_tracking; x right, y up, z towards the visitor
//   webxr      25 joints, the same without the palm; the same axes
//   mediapipe  21 world landmarks of an image that is not mirrored; x right in the image, y down, z away from the camera
// Optional: "tracked", a boolean or one for each joint, true without it; "seq", a whole number that grows; "pinch", the
// tracker's own measure, 0 to 1. While the tracker sees no hand it sends "tracked": false, and "joints" may be missing.
// Sources: Khronos, openxr.h, XrHandJointEXT; W3C, WebXR Hand Input; MediaPipe, HandLandmarkerResult, and
// google-ai-edge/mediapipe#4205 on the axes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include <mechane/driver.h>

namespace mechane::drivers {

using HandPoint = std::array<double, 3>;
inline constexpr std::size_t kJointsOfFinger = 4;
/// The joint of a finger (thumb, index, middle, ring, little) from the palm to its tip, among the points of a hand. The
/// wrist is point 0.
[[nodiscard]] constexpr std::size_t point_of(std::size_t finger, std::size_t joint) noexcept {
  return 1 + kJointsOfFinger * finger + joint;
}
using HandPoints = std::array<HandPoint, point_of(MECHANE_FINGERS, 0)>;

struct HandDatagram {
  bool left = false;
  bool tracked = false;                   ///< all its joints; without it the points mean nothing
  std::optional<std::uint64_t> sequence;  ///< "seq"
  std::optional<double> pinch;            ///< 0 open .. 1 closed
  HandPoints points{};                    ///< metres; x right, y up, z backwards, whatever the format
};

inline constexpr std::size_t kLongestHandDatagram = std::size_t{16} * 1024;

/// Reads a datagram into `out`, which stays as it was when the text is not a hand. Returns "", or what is wrong, for
/// people. nlohmann::json allocates a tree here for every datagram. Any thread; bytes from outside may be anything.
[[nodiscard]] const char* parse_hand_datagram(std::string_view text, HandDatagram& out);

}  // namespace mechane::drivers
