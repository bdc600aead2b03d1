// Files that the recorder writes: appended to all or nothing, or replaced whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::record {

/// `name` with everything but letters, digits, '.', '-' and '_' replaced by '_', and no dot in front: one component of a path.
[[nodiscard]] std::string file_name_of(const std::string& name);

/// Writes a file beside `path`, flushes it to the disk, renames it to `path` and flushes the folder.
[[nodiscard]] Expected<void> replace_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// The regular files of a folder, in no order. Files that vanish meanwhile are left out; no folder, no files.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder);

/// A new file that only grows. It is locked (flock) while open: who else looks at the folder can tell that somebody writes it.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  /// Errors: it exists already, no room, no rights.
  [[nodiscard]] static Expected<AppendFile> create(const std::filesystem::path& path);
  /// True when nobody holds the file open as an AppendFile, in this process or another.
  [[nodiscard]] static bool is_free(const std::filesystem::path& path);

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// All of `bytes` or none of them: on an error the file is cut back to what it was.
  [[nodiscard]] Expected<void> append(std::span<const std::byte> bytes);
  /// Flushes to the disk.
  [[nodiscard]] Expected<void> sync();
  void close();

 private:
  int fd_ = -1;
  std::uint64_t size_ = 0;
  std::string name_;
};

}  // namespace mechane::record
