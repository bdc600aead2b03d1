// The hash of a file's content: caches and the wire name the file by it, so that its path does not matter.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "server/base/error.hpp"

namespace mechane::content {

/// XXH3-128 of the file's bytes, 32 hexadecimal digits. Not for loop threads: it reads the disk. Errors: not_found, io_failure.
[[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file);

/// The same of bytes in memory.
[[nodiscard]] std::string content_hash(std::span<const std::byte> bytes);

/// The digits of a hash that people are shown.
[[nodiscard]] inline std::string short_hash(const std::string& hash) {
  return hash.substr(0, 8);
}

}  // namespace mechane::content
