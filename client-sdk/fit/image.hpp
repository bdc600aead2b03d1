// Pictures as pixels, and as the bytes of a PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mechane::fit {

/// sRGB, rows from the top, alpha not premultiplied.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 width height
};

/// Empty if there is not enough memory.
[[nodiscard]] std::vector<std::byte> encode_png(const Image& image);

[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

}  // namespace mechane::fit
