// Sizes of pictures and places in them, in pixels.
#pragma once

#include <cstdint>

namespace mechane::picture {

struct PixelSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  friend bool operator==(const PixelSize&, const PixelSize&) = default;
};

/// A place in the picture, in pixels; (0, 0) is the upper left corner.
struct PixelPlace {
  double x = 0;
  double y = 0;
};

}  // namespace mechane::picture
