// Writes a file completely, or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "client-sdk/fit/interruption.hpp"
#include "server/base/error.hpp"

namespace mechane::fit {

/// Creates the folder if it is missing, and checks that it can be written: before the long work, not after it.
[[nodiscard]] Expected<void> prepare_folder(const std::filesystem::path& folder);

/// Writes a draft beside `file`, syncs it to the disk and renames it. On failure the draft is removed; an older `file`
/// stays until the rename. Errors: a full disk, a folder that cannot be written.
[[nodiscard]] Expected<void> write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes,
                                         Interruption& interruption);

}  // namespace mechane::fit
