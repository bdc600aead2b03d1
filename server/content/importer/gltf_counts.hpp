// How much a glTF file asks for, before anything is made of it. A file of one kilobyte can place a mesh a billion times, or share one list of
// vertices among thousands of meshes, each of which gets a copy.
#pragma once

#include <filesystem>

#include "server/base/error.hpp"
#include "server/content/import_limits.hpp"

namespace mechane::content {

/// A file whose JSON is faulty, or that is not glTF, is left to the reader to refuse. Errors: over the limits.
[[nodiscard]] Expected<void> check_gltf_counts(const std::filesystem::path& file, const ImportLimits& limits);

}  // namespace mechane::content
