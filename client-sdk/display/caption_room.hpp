// Many or large words cover what they speak of: the view then makes room above them. Pure: all that is timed takes the display's clock as an argument.
#pragma once

#include <optional>

#include "server/base/clock.hpp"

namespace mechane::display {

class CaptionRoom {
 public:
  /// Of the picture's height, covered from below: scenes are framed for captions of two lines.
  static constexpr double kFramedFor = 0.33;
  static constexpr double kMost = 1.8;  ///< or what is seen becomes too small to work on
  static constexpr double kFollows_s = 0.4;

  /// Once a picture, what its caption covers. The first is taken at once, later ones are followed smoothly: a hint that comes is not a cut.
  void see(double covered_below, TimePoint now);
  /// For Camera::room_below.
  [[nodiscard]] double room_below() const { return room_below_; }

 private:
  double room_below_ = 1;
  std::optional<TimePoint> seen_;
};

}  // namespace mechane::display
