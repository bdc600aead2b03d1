// Drafts that are being tried, as files beside the exhibits that they are of.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::studio {

/// Its name in the exhibit's folder, and that of the folder of files that the draft alone has.
inline constexpr std::string_view kPreviewFile = ".preview.x3d";
inline constexpr std::string_view kPreviewFiles = ".preview";

/// Writes the file in one step, and makes the folder where it is missing. Returns its path. Errors: io_failure.
[[nodiscard]] Expected<std::filesystem::path> write_preview(const std::filesystem::path& folder, std::string_view text);
/// The text, with these files of the draft's own in kPreviewFiles.
[[nodiscard]] std::string with_preview_files(std::string text, const std::vector<std::string>& names);
/// Removes the file and the draft's own files, and their folder if it is empty then. A file that is not there is no error.
void remove_preview(const std::filesystem::path& file);
/// The same of all that were left in a museum's folder of exhibits, by a program that was ended at once.
void remove_previews(const std::filesystem::path& scenarios);

}  // namespace mechane::studio
