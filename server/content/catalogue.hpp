// The catalogue of a museum's content: one SQLite file beside the files that it describes, each with its hash, its languages, whose it
// is, and what refers to what. The files stay where they are; the catalogue is made from them in a second.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/base/error.hpp"

namespace mechane::content {

enum class ContentKind : std::uint8_t { scenario, model, part, texture, sound, text };
inline constexpr std::size_t kContentKinds = 6;

/// "scenario", "model", ...
[[nodiscard]] std::string_view word_of(ContentKind kind);
[[nodiscard]] std::optional<ContentKind> kind_of_word(std::string_view word);
/// By the ending of a file's name; nothing for a file that is not content by itself.
[[nodiscard]] std::optional<ContentKind> kind_of_file(const std::filesystem::path& file);

/// What is known about a file but is not in its bytes. Empty: unknown.
struct Credits {
  std::string licence;
  std::string source;
  std::string author;
  std::string version;
  bool operator==(const Credits&) const = default;
};

struct CatalogueEntry {
  std::string path;  ///< from the catalogue's folder, with '/'; names the entry
  ContentKind kind = ContentKind::model;
  std::string name;  ///< a scenario's id; of other files the name without its ending
  std::string hash;  ///< content_hash() of the file
  std::uint64_t bytes = 0;
  Credits credits;
  std::map<std::string, std::string> titles;  ///< by language
  std::vector<std::string> languages;         ///< sorted; empty: it has no words, or their language is unknown
  std::vector<std::string> tags;              ///< sorted
  std::vector<std::string> refers_to;         ///< sorted paths, from the catalogue's folder; not all need be entries
  /// Words that a scenario says, and the languages in which it says them: "step turn, caption" -> el, en.
  std::map<std::string, std::vector<std::string>> wordings;
  bool operator==(const CatalogueEntry&) const = default;
};

/// The folder that a catalogue is in, absolute: its paths are relative to it. The catalogue need not exist.
[[nodiscard]] std::filesystem::path folder_of_catalogue(const std::filesystem::path& file);

/// Whether a path can be that of an entry: relative and without "." and "..", so that it stays in the catalogue's folder.
[[nodiscard]] bool is_inside(std::string_view path);

/// `path` relative to the catalogue's folder; the file need not exist. Errors: conflict (it lies elsewhere), io_failure.
[[nodiscard]] Expected<std::string> path_inside(const std::filesystem::path& folder, const std::filesystem::path& path);

/// One open catalogue. Not thread-safe, and never for a loop thread: it reads the disk. Several programs may have the same file open; a
/// writer waits up to five seconds for another one.
class Catalogue {
 public:
  enum class Access : std::uint8_t { read, write };

  /// With Access::write, a file that does not exist is made; its folder must exist. Errors: not_found; invalid_value (not a file, or
  /// another program's database); wrong_version (a newer Mechane's); damaged; io_failure.
  [[nodiscard]] static Expected<Catalogue> open(const std::filesystem::path& file, Access access);
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;
  ~Catalogue();

  struct Changes {
    std::vector<std::string> added;    ///< paths, in the order given
    std::vector<std::string> changed;  ///< the file's bytes have changed since its entry was written
    std::vector<std::string> retold;   ///< the file is as it was, but something else that is known about it has changed
    std::size_t same = 0;
  };
  /// Writes all entries, or on an error none. An entry replaces the one with its path; one that is already there as it is, is not
  /// written again.
  [[nodiscard]] Expected<Changes> put(std::span<const CatalogueEntry> entries);
  /// Deletes the entries with these paths, or on an error none of them; files stay. Returns how many there were.
  [[nodiscard]] Expected<std::size_t> remove(std::span<const std::string> paths);

  /// All entries, sorted by path. Errors: damaged.
  [[nodiscard]] Expected<std::vector<CatalogueEntry>> entries() const;
  /// The files whose content had this hash when they were added, as absolute paths. They may have changed since.
  [[nodiscard]] Expected<std::vector<std::filesystem::path>> files_of(const std::string& hash) const;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// Absolute; the paths of entries are relative to it.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Connection;
  Catalogue(std::filesystem::path file, std::unique_ptr<Connection> connection);
  std::filesystem::path file_;
  std::filesystem::path folder_;
  std::unique_ptr<Connection> connection_;
};

/// The entries that a person means by `word`: those with this path, else with this name, else whose hash begins with it (six digits or
/// more). Several files may share a name.
[[nodiscard]] std::vector<CatalogueEntry> find_entries(std::span<const CatalogueEntry> entries, std::string_view word);

}  // namespace mechane::content
