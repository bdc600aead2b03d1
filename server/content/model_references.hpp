// Which other files a model needs beside itself.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "server/base/error.hpp"

namespace mechane::content {

/// Whether this is a piece of a model, a .bin or .mtl: content only where a model refers to it.
[[nodiscard]] bool is_piece_of_model(const std::filesystem::path& file);

/// Paths from the model's folder, as the file writes them: buffers and images of a .gltf or .glb that are not in it, the .mtl files of an
/// .obj, and the images of those. Formats that name no others have none. Whether the files are there is not asked, except for a .mtl,
/// which is read. What is not a path in a folder (data:, http://, an absolute one) is left out. Errors: the model cannot be read.
[[nodiscard]] Expected<std::set<std::string>> files_of_model(const std::filesystem::path& model);

}  // namespace mechane::content
