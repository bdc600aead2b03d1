// The compiled object as bytes (a .part file): versioned, checksummed, little endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "server/base/error.hpp"
#include "server/collision/object.hpp"

namespace mechane::collision {

/// Raised with every change of the layout: a reader takes no older version, and the cache builds the object again.
inline constexpr std::uint32_t kPartFileVersion = 3;
/// Of a file that holds a DistanceField; the rest is as before, so that files without one stay what they were. In version 4 no leaf
/// spans several blocks; otherwise it is the same, and is read.
inline constexpr std::uint32_t kFieldFileVersion = 5;

[[nodiscard]] std::vector<std::byte> write_object(const Object& object);

/// Reads what write_object wrote. Any other bytes are an Error: wrong_version; or damaged (another kind of file, a checksum that does
/// not match, counts or values out of range). Never trusts a count beyond the bytes that are there.
[[nodiscard]] Expected<Object> read_object(std::span<const std::byte> bytes);

/// read_object of a whole file, with the file's name in the Error: also those of read_whole. Reads no more than a part file may have.
[[nodiscard]] Expected<Object> load_object(const std::filesystem::path& file);

/// Writes the checksum that belongs to the rest of the bytes into their end: for tests and fuzzers that damage a file on purpose and
/// want to get past the checksum. Does nothing to fewer than 8 bytes.
void reseal(std::span<std::byte> bytes);

}  // namespace mechane::collision
