// Alpha encoding: the lines of text that LucidGloves, and gloves that follow them, exchange with a host. A line is
// letters, each with a number behind it where it has one: "A0B4095C12...\n". Sources: LucidVR/lucidgloves, firmware,
// AlphaEncoding.cpp, Main.cpp and InputManager.cpp; LucidVR/opengloves-driver, alpha_encoding_service.cpp and
// hand_tracking.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <mechane/driver.h>

namespace mechane::drivers {

/// A hand as one line tells it. Fingers from the thumb on.
struct AlphaHand {
  std::array<double, MECHANE_FINGERS> curl{};   ///< 0 open .. 1 closed
  std::array<double, MECHANE_FINGERS> splay{};  ///< -1 .. 1, the same turn for all fingers; 0: the glove does not tell
  /// Share of each joint's range, from the palm outwards; where the glove does not tell it, the finger's curl.
  std::array<std::array<double, 3>, MECHANE_FINGERS> flexion{};
  /// Bit 0: H (stick), then I (trigger), J, K, L (grab), M (pinch), N (menu), O (calibrate).
  std::uint32_t buttons = 0;
  /// False while button O is pressed, and until a finger has moved: before that the firmware says half for all five.
  bool calibrated = false;
};

enum class AlphaLine {
  hand,          ///< all five curls
  other,         ///< an empty line, or what the firmware says of itself
  malformed,     ///< torn, or another encoding
  beyond_range,  ///< a number over the full scale
};

/// Reads one line without its '\n'. `full_scale`: 4095, or 1023 on 8-bit boards. `hand` changes only for
/// AlphaLine::hand. Any thread; allocates nothing.
[[nodiscard]] AlphaLine decode_alpha(std::string_view line, int full_scale, AlphaHand& hand) noexcept;

/// Puts lines together from bytes as they arrive. One thread; allocates nothing.
class AlphaStream {
 public:
  explicit AlphaStream(int full_scale) noexcept : full_scale_(full_scale) {}

  void add(std::string_view bytes) noexcept;

  /// Of the newest line that had one.
  [[nodiscard]] const AlphaHand& hand() const noexcept { return hand_; }
  /// How many lines had a hand so far.
  [[nodiscard]] std::uint64_t hands() const noexcept { return hands_; }
  /// What came last that is neither a hand nor `other`, if it came after the newest hand; else AlphaLine::hand.
  [[nodiscard]] AlphaLine trouble() const noexcept { return trouble_; }

 private:
  void end_line() noexcept;

  int full_scale_;
  std::array<char, 256> line_{};  // the longest that is known has some 200 characters
  std::size_t size_ = 0;          // may be over the size of line_: the line is too long
  AlphaHand hand_;
  std::uint64_t hands_ = 0;
  AlphaLine trouble_ = AlphaLine::hand;
};

/// Angles of the joints as driver.h orders them, radians: shares of a nominal range. Flexion, by the American Academy
/// of Orthopaedic Surgeons: thumb 15, 50 and 80 degrees, fingers 90, 100 and 90. Abduction: 20 degrees to either side.
void place_joints(const AlphaHand& hand, double (&joints_rad)[MECHANE_HAND_JOINTS]) noexcept;
/// 0 open .. 1 closed: the mean curl of the four fingers. A fist leaves the thumb half open, and some gloves have none.
[[nodiscard]] double grasp_of(const AlphaHand& hand) noexcept;

/// Where each string stops, from the thumb on: 0 free .. 1000 at the open hand.
using StringLimits = std::array<int, MECHANE_FINGERS>;
using AlphaText = std::array<char, 64>;

/// The line that sets all five, in `text`. Firmware differs in what it does with a finger that a line leaves out.
[[nodiscard]] std::string_view encode_limits(const StringLimits& limits, AlphaText& text) noexcept;

}  // namespace mechane::drivers
