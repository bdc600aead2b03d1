// A hand's movement as a text file: what `mechane haptic --record` writes, and what a person or a script may write.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <mechane/driver.h>

namespace mechane::drivers {

/// The hand at one moment of a recording.
struct RecordedHand {
  double t_s = 0;
  mechane_device_state state{};  ///< its flags are not recorded
};

/// A line is one moment: t_s x y z qw qx qy qz grasp buttons, and for a glove the 20 joints behind them. Times rise; blank lines and
/// those that begin with # are left out. A line "left" before the first moment: it is a left hand. Any thread.
struct HandRecording {
  std::vector<RecordedHand> hands;  ///< one at least
  bool is_glove = false;
  bool is_left = false;

  /// What is wrong with the text, in words for a person with the line's number; empty: nothing.
  [[nodiscard]] std::string take_text(std::string_view text);
  /// From the first moment to the last, s.
  [[nodiscard]] double length_s() const noexcept { return hands.back().t_s - hands.front().t_s; }
  /// The hand `t_s` after the first moment, between the moments beside it; before the first and after the last it stands still.
  [[nodiscard]] mechane_device_state at(double t_s) const noexcept;
};

}  // namespace mechane::drivers
