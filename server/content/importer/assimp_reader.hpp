// A mesh file to an ImportedScene through assimp. Runs in the child process only.
#pragma once

#include <filesystem>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"
#include "server/content/imported_scene.hpp"

namespace mechane::content {

/// Reads glb, gltf, obj, stl and ply. The error's `where` is a place inside the file. Errors: not_supported (another format, by the file's
/// name), damaged, and those of check_gltf_counts and read_materials. May throw what assimp throws (std::bad_alloc when memory is limited).
[[nodiscard]] Expected<ImportedScene> read_with_assimp(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace mechane::content
