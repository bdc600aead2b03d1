// How long words have been shown, which turns the pages of long ones, and where they were in the last picture, where they stay. The time is an
// argument.
#pragma once

#include <optional>
#include <string>

#include "client-sdk/draw/text/overlay_layout.hpp"
#include "client-sdk/picture/overlay_content.hpp"
#include "server/base/clock.hpp"

namespace mechane::display {

class CaptionHistory {
 public:
  /// Adds this to the content of the next picture; call it once a picture. Other words begin anew, in their usual place; in a picture of another
  /// size all words do.
  void tell(picture::OverlayContent& content, picture::PixelSize eye, TimePoint now);
  /// Takes where the words of that picture were drawn.
  void see(const draw::OverlayLayout& drawn);

 private:
  struct Words {
    std::string text;
    TimePoint from;
    std::optional<picture::PictureBox> at;

    /// How long this text has been shown, seconds.
    float tell(const std::string& shown, TimePoint now);
  };
  Words caption_, note_;
  picture::PixelSize eye_{0, 0};
};

}  // namespace mechane::display
