// How the pictures of two eyes become one picture, and which eye sees what of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "client-sdk/picture/camera.hpp"
#include "client-sdk/picture/pixels.hpp"

namespace mechane::picture {

enum class Stereo : std::uint8_t {
  mono,
  side_by_side,           ///< left eye in the left half, for two screens beside each other; pixels are square
  top_bottom,             ///< left eye in the upper half, likewise
  side_by_side_squeezed,  ///< each half is squeezed to half its width: a 3D television stretches it over its whole screen
  top_bottom_squeezed,    ///< each half is squeezed to half its height, likewise
  anaglyph,               ///< for red-cyan glasses, the left eye behind red
  row_interleaved,        ///< rows alternate; a setting of the renderer says which eye has the uppermost row
  quad_buffer,            ///< two full pictures, for a window whose driver shows both
  left_eye,               ///< one eye's full picture, for one of two projectors
  right_eye,
};

/// The name on the command line: "sbs", "top-bottom" ...
[[nodiscard]] std::string_view stereo_name(Stereo stereo);
/// All of them with their names, in the order above.
[[nodiscard]] const std::vector<std::pair<std::string_view, Stereo>>& stereo_names();

/// Whose pictures are drawn, in order.
[[nodiscard]] std::vector<Eye> eyes_of(Stereo stereo);

/// Pixels of one eye's picture within a picture of this size.
[[nodiscard]] PixelSize eye_size(Stereo stereo, PixelSize picture);
/// The same size as the eye sees it, on a screen that stretches squeezed pictures again. A layout in these pixels has
/// the right proportions on the screen.
[[nodiscard]] PixelSize seen_size(Stereo stereo, PixelSize picture);

/// Width over height.
[[nodiscard]] double aspect_of(PixelSize size);

/// The second eye's picture stands to the right of the first one's, or below it.
[[nodiscard]] bool is_side_by_side(Stereo stereo);
[[nodiscard]] bool is_top_bottom(Stereo stereo);

/// A place in the picture as an eye sees it. Where both eyes share the pixels, an eye in the middle stands for both:
/// exact for things in the plane of the screen, for others within half their parallax.
struct EyePlace {
  Eye eye = Eye::middle;
  double x = 0;       ///< -1 left .. 1 right
  double y = 0;       ///< -1 below .. 1 above
  double aspect = 1;  ///< of the eye's picture, as it is seen
};
[[nodiscard]] EyePlace eye_at(Stereo stereo, PixelSize picture, PixelPlace place);

}  // namespace mechane::picture
