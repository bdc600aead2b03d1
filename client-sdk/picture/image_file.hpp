// PNG and JPEG in, PNG out.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "client-sdk/picture/scene_assets.hpp"
#include "server/base/error.hpp"

namespace mechane::picture {

/// Decodes a PNG or JPEG. `where` names it in errors: not an image, or over 8192 pixels a side.
[[nodiscard]] Expected<ImageData> decode_image(std::span<const std::byte> bytes, const std::string& where);

/// Writes a PNG, under a temporary name first, so that a reader never sees half of one. Errors: the disk is full, no such folder.
[[nodiscard]] Expected<void> write_png(const ImageData& image, const std::string& path);

}  // namespace mechane::picture
