// The name of a file's content: what caches and the wire call it by, whatever its path.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "server/base/error.hpp"

namespace mechane::content {

/// XXH3-128 of the file's bytes, 32 hexadecimal digits. Not for loop threads: it reads the disk.
[[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file);

/// The same of bytes in memory.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);

}  // namespace mechane::content
