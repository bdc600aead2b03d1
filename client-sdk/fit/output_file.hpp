// Writing a file so that it is there whole, or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "client-sdk/fit/interruption.hpp"
#include "server/base/error.hpp"

namespace mechane::fit {

/// Makes the folder when it is missing, and checks that a file can be made in it: before the long work, not after it.
[[nodiscard]] Expected<void> prepare_folder(const std::filesystem::path& folder);

/// Writes a draft beside `file`, forces it to the disk and renames it. The draft is gone whatever happens; an older `file` stays until
/// the rename. Errors: a full disk, a folder that cannot be written.
[[nodiscard]] Expected<void> write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes,
                                         Interruption& interruption);

/// The bytes of a file that was written a moment ago.
[[nodiscard]] Expected<std::vector<std::byte>> read_whole(const std::filesystem::path& file);

}  // namespace mechane::fit
