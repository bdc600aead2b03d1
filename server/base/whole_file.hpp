// Writing a file in one step: afterwards it is there as a whole, or as it was before. And reading one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane {

enum class WholeFile : std::uint8_t {
  /// For a folder that several programs write to at the same time, such as a cache: each draft has a name of its own. The folder is made
  /// where it is missing. Only the user can read the file. A power cut soon afterwards may lose it.
  shared,
  /// For a single writer: the draft is FILE.new. The group can read the file. It and its folder are flushed to the disk, so that it is
  /// still there after a power cut.
  durable,
  /// The same for a file that its user passes on, such as a scenario or a picture: who can read it is up to the user's umask. A link
  /// to a file stays one; a device or a pipe, such as /dev/stdout, is written into.
  document,
};

/// Writes a draft beside `file`, and renames it to `file`. Errors: io_failure, with the system's reason; the draft is removed. Any thread
/// but those of loops.
[[nodiscard]] Expected<void> write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes,
                                         WholeFile how);

/// Writes all bytes to a descriptor. Returns 0, or errno.
[[nodiscard]] int write_all(int fd, std::span<const std::byte> bytes);

/// Flushes a file or a folder to the disk. Returns 0, or errno.
[[nodiscard]] int flush_to_disk(const std::filesystem::path& path);

/// An io_failure such as "cannot be written: No space left on device": `what`, and the system's words for `error`, an errno. The remedy
/// depends on whether the disk is full.
[[nodiscard]] Error file_error(const std::string& what, const std::filesystem::path& file, int error);

/// All bytes of a file. Errors: not_found, too_large (more than `most_bytes`), io_failure (a folder, no right to read it, a failing disk).
/// Any thread but those of loops.
[[nodiscard]] Expected<std::vector<std::byte>> read_whole(const std::filesystem::path& file, std::uintmax_t most_bytes);

/// Bytes as the text that they are. It looks into them.
[[nodiscard]] inline std::string_view as_text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace mechane
