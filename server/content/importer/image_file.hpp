// An image beside a model, as it is in its file.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "server/base/error.hpp"
#include "server/content/imported_scene.hpp"
#include "server/content/importer/folder_io.hpp"

namespace mechane::content {

/// A PNG or JPEG file's bytes as a texture; they are not decoded. Errors: not_supported.
[[nodiscard]] Expected<ImportedTexture> encoded_texture(const std::string& name, std::span<const std::byte> bytes);

/// The same of a file that the model names, by its path from the model's folder. Errors: not_found (also where it lies outside that
/// folder), not_supported, io_failure.
[[nodiscard]] Expected<ImportedTexture> texture_file(const FolderIo& io, std::string name);

}  // namespace mechane::content
