// Makes room in the view for long or large captions, which would cover the scene. Pure: the time is an argument.
#pragma once

#include <optional>

#include "server/base/clock.hpp"

namespace mechane::display {

class CaptionRoom {
 public:
  /// Share of the picture's height that a caption of two lines covers; scenes are framed for this.
  static constexpr double kFramedFor = 0.33;
  static constexpr double kMost = 1.8;  ///< with more, things would become too small to work on
  static constexpr double kFollows_s = 0.4;

  /// Takes the share that the caption covers; call it once a picture. The first is used at once, later ones are
  /// followed smoothly, so that a new hint does not make the picture jump.
  void see(double covered_below, TimePoint now);
  /// The value for Camera::room_below.
  [[nodiscard]] double room_below() const { return room_below_; }

 private:
  double room_below_ = 1;
  std::optional<TimePoint> seen_;
};

}  // namespace mechane::display
