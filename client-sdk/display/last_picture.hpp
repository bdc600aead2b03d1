// The picture that a display showed last, as far as a press on it must be understood.
#pragma once

#include <optional>

#include "client-sdk/draw/overlay_layout.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::display {

struct LastPicture {
  picture::PixelSize size;  ///< of the window now
  picture::Stereo stereo = picture::Stereo::mono;
  const draw::OverlayLayout* overlay = nullptr;  ///< what was written in it
  bool has_panel = false;                        ///< questions lay over the rest

  /// The button at a place of the whole picture; none: there is no button.
  [[nodiscard]] std::optional<picture::OverlayAction> button_at(picture::PixelPlace place) const;
};

}  // namespace mechane::display
