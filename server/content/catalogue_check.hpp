// `mechane content verify`: compares a catalogue with the files beside it.
#pragma once

#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::content {

struct CatalogueFault {
  enum class Kind : std::uint8_t {
    changed,     ///< the file has changed since it was added
    gone,        ///< the file does not exist any more
    missing,     ///< a file that another one refers to is not an entry
    language,    ///< a scenario has some words in one of its languages and not in another
    orphan,      ///< nothing refers to it
    unknown,     ///< a file in the folder that is not an entry
    twice,       ///< two scenarios have the same id
    no_licence,  ///< whether it may be shown is unknown; a note, not an error
  };
  Kind kind = Kind::changed;
  std::string path;  ///< from the catalogue's folder
  std::string what;
  std::string remedy;

  [[nodiscard]] bool is_note() const { return kind == Kind::no_licence; }
};

/// "changed", "gone", ...
[[nodiscard]] std::string_view word_of(CatalogueFault::Kind kind);

/// All faults, sorted by path. Reads every file of the catalogue. Errors: the catalogue or its folder cannot be read.
[[nodiscard]] Expected<std::vector<CatalogueFault>> verify(const Catalogue& catalogue);

/// The content in a folder and all folders below it, as sorted absolute paths. A text counts as content where a scenario of the same name
/// lies beside it ("screw.x3d": "screw.md", "screw.el.md"); hidden files, links and catalogues do not. Errors: io_failure; too_large (more
/// than 100 000 files).
[[nodiscard]] Expected<std::vector<std::filesystem::path>> content_in(const std::filesystem::path& folder);

/// These entries, all entries that they refer to, directly or through others; sorted by path.
[[nodiscard]] std::vector<CatalogueEntry> with_all_referred(std::span<const CatalogueEntry> all,
                                                            std::vector<CatalogueEntry> wanted);

}  // namespace mechane::content
