// Keeps a folder of journals within a size: the oldest ones are deleted first, except those that are being written.
#pragma once

#include <cstdint>
#include <filesystem>

#include "server/base/error.hpp"

namespace mechane::record {

inline constexpr const char* kJournalExtension = ".journal";

struct RetentionResult {
  std::uint64_t bytes = 0;    ///< of all journals that are left
  std::uint64_t deleted = 0;  ///< journals
};

/// Deletes closed journals, the one that was written first before the others, until all journals together have at most `max_bytes`.
/// Journals that are being written count, but stay. Errors: io_failure, where a file cannot be deleted; the others are deleted all the
/// same.
[[nodiscard]] Expected<RetentionResult> keep_within(const std::filesystem::path& folder, std::uint64_t max_bytes);

}  // namespace mechane::record
