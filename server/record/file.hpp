// Files that the recorder appends to, each time all or nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::record {

/// `name` as one component of a path: everything but letters, digits, '.', '-' and '_' is replaced by '_', and a dot at the start too.
[[nodiscard]] std::string file_name_of(const std::string& name);

/// The regular files of a folder, in no order. Files that vanish meanwhile are left out. Empty where there is no such folder.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder);

/// A new file that only grows. It is locked (flock) while it is open, so that retention can tell that it is being written.
class AppendFile {
 public:
  AppendFile() = default;
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  /// Errors: io_failure (it exists already, no room, no rights).
  [[nodiscard]] static Expected<AppendFile> create(const std::filesystem::path& path);
  /// True when no AppendFile of any process has the file open.
  [[nodiscard]] static bool is_free(const std::filesystem::path& path);

  [[nodiscard]] bool is_open() const { return fd_ >= 0; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Appends all of `bytes`, or none of them: on an error the file is cut back to what it was.
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
