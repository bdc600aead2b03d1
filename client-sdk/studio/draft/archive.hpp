// An exhibit as one file, to pass on or to keep: a zip archive of NAME/NAME.x3d and NAME/files/FILE.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::studio {

inline constexpr std::size_t kMostArchiveBytes = std::size_t{128} << 20U;

/// A file that goes into an archive.
struct ArchiveSource {
  std::string name;  ///< there; is_file_name()
  std::filesystem::path path;
};

/// The archive's bytes, which depend on its content alone: not on times, owners or the compression library. Errors: not_found; io_failure;
/// too_large.
[[nodiscard]] Expected<std::string> write_archive(const std::string& name, std::string_view text,
                                                  std::span<const ArchiveSource> files);

struct ArchivedExhibit {
  std::string name;  ///< is_exhibit_name()
  std::string text;  ///< not read as X3D yet
};

/// Gets the files of an archive, one after another. Its error ends the reading.
using TakeFile = std::function<Expected<void>(const std::string& name, std::span<const std::byte> bytes)>;

/// Reads an archive of unknown origin. Its list of entries is checked as a whole before `take` is called: their names, kinds and sizes,
/// and how they are stored. Each name is an is_file_name() and comes once; one file at a time is in memory. Errors: invalid_value (no
/// archive, damaged, entries that an exhibit does not have); duplicate; missing (no X3D file); not_supported (encrypted, links, another
/// compression); too_large; those of `take`.
[[nodiscard]] Expected<ArchivedExhibit> read_archive(std::span<const std::byte> bytes, const TakeFile& take);

}  // namespace mechane::studio
