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
/// By the ending of a file's name; none for what is not content by itself.
[[nodiscard]] std::optional<ContentKind> kind_of_file(const std::filesystem::path& file);

/// What is known of a file, and not from its bytes. Empty: unknown.
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
  std::vector<std::string> languages;         ///< sorted; empty: it has no words, or nobody said
  std::vector<std::string> tags;              ///< sorted
  std::vector<std::string> refers_to;         ///< sorted paths, from the catalogue's folder; not all need be entries
  /// Words that a scenario says, and the languages in which it says them: "step turn, caption" -> el, en.
  std::map<std::string, std::vector<std::string>> wordings;
  bool operator==(const CatalogueEntry&) const = default;
};

/// What the paths in a catalogue, there or not, are relative to: the folder that it is in, absolute.
[[nodiscard]] std::filesystem::path folder_of_catalogue(const std::filesystem::path& file);

/// Whether a path can be an entry's: relative, without "." and "..", so that it stays in the catalogue's folder.
[[nodiscard]] bool is_inside(std::string_view path);

/// What of `path`, an existing file or not, is left from the catalogue's folder. Errors: it lies elsewhere.
[[nodiscard]] Expected<std::string> path_inside(const std::filesystem::path& folder, const std::filesystem::path& path);

/// One open catalogue. Not thread-safe, and never for a loop thread: it reads the disk. Several programs may have the same file open; a
/// writer waits up to five seconds for another one.
class Catalogue {
 public:
  enum class Access : std::uint8_t { read, write };

  /// With Access::write the file is made where there is none (its folder must be there). Errors: no such file, no catalogue, one of a
  /// newer Mechane, a damaged one, no right to read or write.
  [[nodiscard]] static Expected<Catalogue> open(const std::filesystem::path& file, Access access);
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;
  ~Catalogue();

  struct Changes {
    std::vector<std::string> added;    ///< paths, in the order given
    std::vector<std::string> changed;  ///< the file has other bytes than its entry said
    std::vector<std::string> retold;   ///< the file is as it was, and something else is known of it
    std::size_t same = 0;
  };
  /// Writes all of them, or on an error none. An entry replaces the one of its path. What is equal is not written at all.
  [[nodiscard]] Expected<Changes> put(std::span<const CatalogueEntry> entries);
  /// Forgets entries (files are left alone): all of them, or on an error none. Returns how many there were.
  [[nodiscard]] Expected<std::size_t> remove(std::span<const std::string> paths);

  /// All, by path. Errors: damaged.
  [[nodiscard]] Expected<std::vector<CatalogueEntry>> entries() const;
  /// The files whose content has this hash, as absolute paths. Whether their bytes still do is the caller's to see.
  [[nodiscard]] Expected<std::vector<std::filesystem::path>> files_of(const std::string& hash) const;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// What the paths of entries are relative to: absolute.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Connection;
  Catalogue(std::filesystem::path file, std::unique_ptr<Connection> connection);
  std::filesystem::path file_;
  std::filesystem::path folder_;
  std::unique_ptr<Connection> connection_;
};

/// The entries that a person means: by path, by name, or by a hash or its first six digits and more. Several files may share a name.
[[nodiscard]] std::vector<CatalogueEntry> find_entries(std::span<const CatalogueEntry> entries, std::string_view word);

}  // namespace mechane::content
