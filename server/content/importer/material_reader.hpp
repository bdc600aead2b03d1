// Materials and images of a scene that assimp has read.
#pragma once

#include "server/base/error.hpp"
#include "server/content/imported_scene.hpp"
#include "server/content/importer/folder_io.hpp"

struct aiScene;

namespace mechane::content {

/// Fills scene.materials and scene.textures; images that lie beside the file are read through `io`. Errors: not_found (an image),
/// not_supported (neither PNG nor JPEG), io_failure.
[[nodiscard]] Expected<void> read_materials(const aiScene& from, const FolderIo& io, ImportedScene& scene);

}  // namespace mechane::content
