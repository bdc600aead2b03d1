// Fetched files on this machine's disk, by content. With them a display can start while its web server is not
// reachable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "server/base/error.hpp"

namespace mechane::assets {

/// What is remembered of a file whose hash was not given.
struct RememberedFile {
  std::string hash;  ///< content::content_hash() of the fetched bytes
  std::string etag;
  std::string modified;
};

/// Called from one thread. Several displays may share a folder: files appear in it complete, under their final name.
class AssetCache {
 public:
  /// The folder is made when the first file is kept. Above `limit_bytes`, the files that were not used for the longest
  /// time are removed.
  AssetCache(std::filesystem::path folder, std::uint64_t limit_bytes);
  ~AssetCache();
  AssetCache(const AssetCache&) = delete;
  AssetCache& operator=(const AssetCache&) = delete;

  /// The file with this content; it is read completely, and removed with a warning if it is damaged. `extension` is
  /// that of the file's name.
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& hash, const std::string& extension);

  /// Writes a file with this content. Where the folder cannot take it (full, or no permission), it goes to a temporary
  /// folder until the cache is destroyed, and the log says so once. Files that this cache has used are not removed to
  /// make room, so a scenario may be larger than the limit. Errors: no room anywhere.
  [[nodiscard]] Expected<std::filesystem::path> keep(std::span<const std::byte> bytes, const std::string& hash,
                                                     const std::string& extension);

  /// By a file's full address. What cannot be read or written counts as not remembered.
  [[nodiscard]] std::optional<RememberedFile> recall(const std::string& address) const;
  void remember(const std::string& address, const RememberedFile& file) const;

 private:
  [[nodiscard]] std::filesystem::path place_of(const std::string& hash, const std::string& extension) const;
  [[nodiscard]] std::filesystem::path note_of(const std::string& address) const;
  [[nodiscard]] Expected<std::filesystem::path> keep_aside(std::span<const std::byte> bytes, const std::string& name);
  void make_room() const;

  std::filesystem::path folder_;
  std::uint64_t limit_bytes_;
  std::set<std::filesystem::path> in_use_;
  std::set<std::filesystem::path> asides_;  ///< temporary folders, removed by the destructor
  bool told_no_room_ = false;
};

/// Whether the text is 32 lower-case hexadecimal digits, as from content::content_hash(): only then may it be part of a
/// path.
[[nodiscard]] bool is_content_hash(const std::string& text);

}  // namespace mechane::assets
