// A file that is there whole, or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "server/base/error.hpp"

namespace mechane::content {

/// Writes a file, and the folders that it lies in: at once and whole under its own name, or not at all, however many write it. Errors: the
/// system's reason. Any thread.
[[nodiscard]] Expected<void> write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace mechane::content
