#include "client-sdk/display/last_picture.hpp"

namespace mechane::display {

std::optional<picture::OverlayAction> LastPicture::button_at(picture::PixelPlace place) const {
  const picture::PixelSize eye = picture::seen_size(stereo, size);
  if (overlay == nullptr || eye.width < 2 || eye.height < 2) return {};
  const picture::EyePlace seen = picture::eye_at(stereo, size, place);
  return draw::action_at(*overlay, (1 + seen.x) / 2 * overlay->size.width, (1 - seen.y) / 2 * overlay->size.height);
}

}  // namespace mechane::display
