// Checks the sizes in a glTF file before the file is read. A file of one kilobyte can place a mesh a billion times, or share one list of
// vertices among thousands of meshes, each of which gets a copy.
#pragma once

#include <filesystem>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"

namespace mechane::content {

/// Accepts a file with faulty JSON, or of another format: the reader refuses it later. Errors: too_large.
[[nodiscard]] Expected<void> check_gltf_counts(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace mechane::content
