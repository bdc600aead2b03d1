// PNG and JPEG in, PNG out.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "client-sdk/picture/scene_assets.hpp"
#include "server/base/error.hpp"

namespace mechane::picture {

/// Decodes a PNG or JPEG. `where` names it in errors. Errors: not an image, or over 8192 pixels a side.
[[nodiscard]] Expected<ImageData> decode_image(std::span<const std::byte> bytes, const std::string& where);

/// Writes a PNG, of which no reader sees half. Errors: io_failure (the disk is full, no such folder), too_large.
[[nodiscard]] Expected<void> write_png(const ImageData& image, const std::string& path);

}  // namespace mechane::picture
