#include "client-sdk/display/caption_room.hpp"

#include <algorithm>
#include <cmath>

namespace mechane::display {

void CaptionRoom::see(double covered_below, TimePoint now) {
  // The scene's part that was visible above a caption of two lines must fit above the present caption.
  const double left = std::clamp(1 - covered_below, 0.01, 1.0);
  const double wanted = std::clamp((1 - kFramedFor) / left, 1.0, kMost);
  const double s = seen_ ? 1 - std::exp(-std::max(to_seconds(now - *seen_), 0.0) / kFollows_s) : 1.0;
  room_below_ += s * (wanted - room_below_);
  seen_ = now;
}

}  // namespace mechane::display
