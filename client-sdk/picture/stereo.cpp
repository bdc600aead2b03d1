#include "client-sdk/picture/stereo.hpp"

#include <algorithm>

#include "server/base/assert.hpp"

namespace mechane::picture {

const std::vector<std::pair<std::string_view, Stereo>>& stereo_names() {
  static const std::vector<std::pair<std::string_view, Stereo>> names{
      {"mono", Stereo::mono},
      {"sbs", Stereo::side_by_side},
      {"top-bottom", Stereo::top_bottom},
      {"sbs-squeezed", Stereo::side_by_side_squeezed},
      {"top-bottom-squeezed", Stereo::top_bottom_squeezed},
      {"anaglyph", Stereo::anaglyph},
      {"rows", Stereo::row_interleaved},
      {"quad", Stereo::quad_buffer},
      {"left", Stereo::left_eye},
      {"right", Stereo::right_eye}};
  return names;
}

std::string_view stereo_name(Stereo stereo) {
  const auto found = std::ranges::find(stereo_names(), stereo, [](const auto& entry) { return entry.second; });
  MECHANE_ASSERT(found != stereo_names().end());
  return found->first;
}

std::vector<Eye> eyes_of(Stereo stereo) {
  switch (stereo) {
    case Stereo::mono:
      return {Eye::middle};
    case Stereo::left_eye:
      return {Eye::left};
    case Stereo::right_eye:
      return {Eye::right};
    default:
      return {Eye::left, Eye::right};
  }
}

bool is_side_by_side(Stereo stereo) {
  return stereo == Stereo::side_by_side || stereo == Stereo::side_by_side_squeezed;
}

bool is_top_bottom(Stereo stereo) {
  return stereo == Stereo::top_bottom || stereo == Stereo::top_bottom_squeezed;
}

PixelSize eye_size(Stereo stereo, PixelSize picture) {
  return {is_side_by_side(stereo) ? picture.width / 2 : picture.width,
          is_top_bottom(stereo) ? picture.height / 2 : picture.height};
}

PixelSize seen_size(Stereo stereo, PixelSize picture) {
  const bool squeezed = stereo == Stereo::side_by_side_squeezed || stereo == Stereo::top_bottom_squeezed;
  return squeezed ? picture : eye_size(stereo, picture);
}

double aspect_of(PixelSize size) {
  return static_cast<double>(size.width) / size.height;
}

EyePlace eye_at(Stereo stereo, PixelSize picture, PixelPlace place) {
  const PixelSize size = eye_size(stereo, picture);
  const std::vector<Eye> eyes = eyes_of(stereo);
  EyePlace out;
  if (eyes.size() == 1) out.eye = eyes.front();
  if (is_side_by_side(stereo) || is_top_bottom(stereo)) {
    const bool second = is_side_by_side(stereo) ? place.x >= size.width : place.y >= size.height;
    out.eye = second ? Eye::right : Eye::left;
    if (second && is_side_by_side(stereo)) place.x -= size.width;
    if (second && is_top_bottom(stereo)) place.y -= size.height;
  }
  out.x = 2 * place.x / size.width - 1;
  out.y = 1 - 2 * place.y / size.height;
  out.aspect = aspect_of(seen_size(stereo, picture));
  return out;
}

}  // namespace mechane::picture
