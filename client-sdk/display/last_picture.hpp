// The last shown picture, as far as presses on it depend on it.
#pragma once

#include <optional>

#include "client-sdk/draw/text/overlay_layout.hpp"
#include "client-sdk/picture/stereo.hpp"

namespace mechane::display {

struct LastPicture {
  picture::PixelSize size;  ///< of the window now
  picture::Stereo stereo = picture::Stereo::mono;
  const draw::OverlayLayout* overlay = nullptr;  ///< its overlay
  bool has_panel = false;                        ///< it had a panel of questions

  /// The button at a place of the whole picture; none: there is no button.
  [[nodiscard]] std::optional<picture::OverlayAction> button_at(picture::PixelPlace place) const;
};

}  // namespace mechane::display
