// Fetched files on this machine's disk, by content: what a display starts with when the server of its assets is away.
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

/// What was last known of a file that nobody gave a hash of.
struct RememberedFile {
  std::string hash;  ///< content::content_hash() of the bytes that came
  std::string etag;
  std::string modified;
};

/// Called from one thread. Several displays may share a folder: files come into it whole, under their final name, or not at all.
class AssetCache {
 public:
  /// The folder is made when the first file is kept. Over `limit_bytes`, the files that were not used for the longest time go.
  AssetCache(std::filesystem::path folder, std::uint64_t limit_bytes);
  ~AssetCache();
  AssetCache(const AssetCache&) = delete;
  AssetCache& operator=(const AssetCache&) = delete;

  /// The file of this content, read through: what was damaged is removed, and told. `extension` is that of the file's name.
  [[nodiscard]] std::optional<std::filesystem::path> find(const std::string& hash, const std::string& extension);

  /// Writes a file of this content. Where the folder cannot hold it (full, not ours to write), it goes to a folder of temporary files
  /// until the cache is destroyed, and the log says so once. Files that this cache gave out or took in are not removed for others'
  /// sake, so a scenario may be larger than the limit. Errors: there is no room anywhere.
  [[nodiscard]] Expected<std::filesystem::path> keep(std::span<const std::byte> bytes, const std::string& hash,
                                                     const std::string& extension);

  /// By a file's whole address. What cannot be read or written is as if it were not there.
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
  std::set<std::filesystem::path> asides_;  ///< folders of temporary files, ours to remove
  bool told_no_room_ = false;
};

/// 32 small hexadecimal digits, as content::content_hash() writes them: only such a text becomes part of a path.
[[nodiscard]] bool is_content_hash(const std::string& text);

}  // namespace mechane::assets
