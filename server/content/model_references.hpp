// Which other files a model needs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <set>
#include <string>

#include "server/base/error.hpp"

namespace mechane::content {

/// Whether this is a piece of a model, a .bin or .mtl: content only where a model refers to it.
[[nodiscard]] bool is_piece_of_model(const std::filesystem::path& file);

/// Paths relative to the model's folder, as the file writes them: buffers and images of a .gltf or .glb that lie outside it, the .mtl files
/// of an .obj, and the images that those name. Models of other formats need no other files. The files need not exist; a .mtl that does is
/// read. What is not a relative path (data:, http://, an absolute path) is left out. Errors: io_failure (the model cannot be read).
[[nodiscard]] Expected<std::set<std::string>> files_of_model(const std::filesystem::path& model);

/// Goes to the JSON of a .glb, and returns how long the file says that it is. Nothing for any other file, whose beginning it goes to.
[[nodiscard]] std::optional<std::uint32_t> seek_glb_json(std::istream& file);

}  // namespace mechane::content
