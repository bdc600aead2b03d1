// From a tracker's head positions to the viewpoint of the picture: smoothed, limited to what a screen can show, and
// returning to the usual place when the tracker falls silent. Pure: time is an argument.
#pragma once

#include <optional>

#include "client-sdk/picture/camera.hpp"
#include <mechane/client/head.hpp>

namespace mechane::display {

/// One screen's. On the display's thread.
class HeadView {
 public:
  /// A tracker that is silent for longer has stopped.
  static constexpr Duration kSilence = std::chrono::milliseconds(500);

  explicit HeadView(const picture::ScreenSetup& screen)
      : screen_(screen), home_{Vec3(0, 0, screen.viewer_distance_m), Vec3::UnitX()}, place_(home_) {}

  /// Takes the newest head position; none: no tracker has sent one. Call it once a picture.
  void advance(const std::optional<client::ViewerHead>& head, TimePoint now);
  /// For for_screen(). Null: nobody is tracked, or the screen's size and the usual distance are not known.
  [[nodiscard]] const picture::HeadPlace* place() const { return away_ ? &place_ : nullptr; }
  /// Whether a tracker has recently sent a head's position.
  [[nodiscard]] bool tracked() const { return tracked_; }

 private:
  [[nodiscard]] picture::HeadPlace limited(const Pose& X_SV) const;

  picture::ScreenSetup screen_;
  picture::HeadPlace home_;
  picture::HeadPlace place_;
  bool tracked_ = false;
  bool away_ = false;  ///< not at home_
  std::optional<TimePoint> advanced_;
};

}  // namespace mechane::display
