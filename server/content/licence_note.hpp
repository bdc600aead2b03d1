// Whose a folder's files are, where a note beside them says so.
#pragma once

#include <filesystem>

#include "server/content/catalogue.hpp"

namespace mechane::content {

/// The licence and the author in a folder's LICENCE or LICENSE, from its SPDX lines ("SPDX-License-Identifier: CC0-1.0"); empty where there
/// are none. Reads the disk.
[[nodiscard]] Credits read_licence_note(const std::filesystem::path& folder);

}  // namespace mechane::content
