// From what a tracker tells of a visitor's head to where the picture is drawn for: smoothly, within what a screen can show, and back to the
// usual place when the tracker falls silent. Pure: time is an argument.
#pragma once

#include <optional>

#include "client-sdk/picture/camera.hpp"
#include <mechane/client/head.hpp>

namespace mechane::display {

/// One screen's. On the display's thread.
class HeadView {
 public:
  /// Longer than any tracker pauses: then it is gone.
  static constexpr Duration kSilence = std::chrono::milliseconds(500);

  explicit HeadView(const picture::ScreenSetup& screen)
      : screen_(screen), home_{Vec3(0, 0, screen.viewer_distance_m), Vec3::UnitX()}, place_(home_) {}

  /// Takes the newest that is known; none: nobody has told. Once a picture.
  void advance(const std::optional<client::ViewerHead>& head, TimePoint now);
  /// For for_screen(). Null: nobody is tracked, or the screen's size and the usual distance are not known.
  [[nodiscard]] const picture::HeadPlace* place() const { return away_ ? &place_ : nullptr; }
  /// A tracker tells of a head, and it is new.
  [[nodiscard]] bool tracked() const { return tracked_; }

 private:
  [[nodiscard]] picture::HeadPlace limited(const Pose& X_SV) const;

  picture::ScreenSetup screen_;
  picture::HeadPlace home_;
  picture::HeadPlace place_;
  bool tracked_ = false;
  bool away_ = false;  ///< from home_
  std::optional<TimePoint> advanced_;
};

}  // namespace mechane::display
