// Where a scenario names other files, with other paths in their place.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "client-sdk/authoring/text_edits.hpp"
#include "server/x3d/document.hpp"

namespace mechane::authoring {

/// From a path as a document has it, without what follows a '#', to another one.
using NewPath = std::function<std::string(const std::string& path)>;

/// Adds the edits that replace relative paths. Addresses on a network stay, and so does what gets no other path, to the byte.
void replace_paths(const x3d::Document& document, const NewPath& new_path, TextEdits& edits);

/// A path relative to `from`, for a file in `to`; both are absolute.
[[nodiscard]] std::string rebased_path(const std::string& path, const std::filesystem::path& from,
                                       const std::filesystem::path& to);

}  // namespace mechane::authoring
