// Keeps a folder of journals within a size: the oldest ones that nobody writes go first.
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

/// Deletes closed journals, by the time of their last write, until all journals together have at most `max_bytes`. Journals that
/// are being written count, and stay. Errors: a file that cannot be deleted; the others are.
[[nodiscard]] Expected<RetentionResult> keep_within(const std::filesystem::path& folder, std::uint64_t max_bytes);

}  // namespace mechane::record
