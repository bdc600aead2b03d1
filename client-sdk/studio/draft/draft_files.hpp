// Meshes and sounds that authors bring into a draft: in its folder until it is published, then beside the exhibit's file. The exhibit names
// them files/NAME.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"
#include "server/x3d/document.hpp"

namespace mechane::studio {

/// What stands before the name in an exhibit's urls, and the name of the folder.
inline constexpr std::string_view kFilesFolder = "files";

/// The folder of discarded drafts, beside the others: no exhibit can have this name.
inline constexpr std::string_view kDiscarded = "discarded";

/// Whether it can be an exhibit's name, and so a folder's: 1 to 31 of a-z, 0-9 and '-', with a letter or digit first; not kDiscarded.
[[nodiscard]] bool is_exhibit_name(std::string_view name);

struct DraftFile {
  std::string name;
  std::uintmax_t bytes = 0;
  bool sound = false;      ///< otherwise a mesh
  bool published = false;  ///< the exhibit's folder has the same
};

/// Any thread, one at a time; it may wait for the disk.
class DraftFiles {
 public:
  static constexpr std::size_t kMostBytes = std::size_t{64} << 20U;  ///< of one
  static constexpr std::uintmax_t kMostOfAll = std::uintmax_t{512} << 20U;
  static constexpr std::size_t kMostFiles = 200;

  DraftFiles(const std::filesystem::path& draft_folder, const std::filesystem::path& exhibit_folder);

  /// Those of the draft and of the exhibit's own folder `files`, by name.
  [[nodiscard]] std::vector<DraftFile> all() const;
  /// The same without a look into them: `published`, where the exhibit has one of this name.
  [[nodiscard]] std::vector<DraftFile> names() const;
  /// Errors: invalid_value (a name or a kind that is not taken, bytes that are not of that kind); conflict (another file has the name, and
  /// `replace` is false); too_large; io_failure, and then it is as it was.
  [[nodiscard]] Expected<void> put(const std::string& name, std::span<const std::byte> bytes, bool replace) const;
  /// The draft's own, or the exhibit's. Errors: not_found.
  [[nodiscard]] Expected<std::filesystem::path> find(const std::string& name) const;
  /// Whether the draft or the exhibit has a file of this name with other bytes than those of `file`.
  [[nodiscard]] bool has_other(const std::string& name, const std::filesystem::path& file) const;
  /// The draft's own and the exhibit's. Errors: not_found; io_failure.
  [[nodiscard]] Expected<void> remove(const std::string& name) const;

 private:
  std::filesystem::path draft_;
  std::filesystem::path exhibit_;
};

/// 1 to 64 of the letters a-z and A-Z, digits, '-', '_' and '.', with a letter or digit first, and the ending of a mesh or a sound.
[[nodiscard]] bool is_file_name(std::string_view name);

/// Whether a path is files/NAME, however it is written.
[[nodiscard]] bool is_own_path(const std::filesystem::path& path);

/// FOLDER/files/NAME for the url files/NAME, where that file is there; empty for every other url.
[[nodiscard]] std::filesystem::path own_file(const std::filesystem::path& folder, const std::filesystem::path& url);

/// Copies the files of a folder that the document names into another one, and returns their names. Errors: io_failure.
[[nodiscard]] Expected<std::vector<std::string>> copy_used(const x3d::Document& document,
                                                           const std::filesystem::path& from,
                                                           const std::filesystem::path& to);

/// Where an exhibit names a file.
struct FileUse {
  std::string place;  ///< "Inline WHEEL"
  int line = 0;
  std::string exhibit{};   ///< whose text that is
  bool draft = false;      ///< it is in its draft; otherwise only in what is published
  std::string language{};  ///< of a sound that says something
};
/// Whether a document names files/NAME.
[[nodiscard]] bool uses_file(const x3d::Document& document, const std::string& name);

}  // namespace mechane::studio
