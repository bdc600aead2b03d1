// `mechane content verify`: what a catalogue says, held against the files beside it.
#pragma once

#include <string>
#include <vector>

#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::content {

struct CatalogueFault {
  enum class Kind : std::uint8_t {
    changed,     ///< the file's bytes are others than when it was added
    gone,        ///< the file is not there
    missing,     ///< a file that another refers to is not an entry
    language,    ///< words that a scenario says in one of its languages and not in another
    orphan,      ///< nothing refers to it
    unknown,     ///< a file in the folder that is not an entry
    twice,       ///< two scenarios of one id
    no_licence,  ///< nobody may know whether it may be shown: a note
  };
  Kind kind = Kind::changed;
  std::string path;  ///< from the catalogue's folder
  std::string what;
  std::string remedy;

  [[nodiscard]] bool is_note() const { return kind == Kind::no_licence; }
};

/// "changed", "gone", ...
[[nodiscard]] std::string_view word_of(CatalogueFault::Kind kind);

/// Every fault, by path. Reads every file of the catalogue. Errors: the catalogue or its folder cannot be read.
[[nodiscard]] Expected<std::vector<CatalogueFault>> verify(const Catalogue& catalogue);

/// The content in a folder, folders in it and all, as sorted absolute paths. A text counts where a scenario of the same name lies beside
/// it ("screw.x3d": "screw.md", "screw.el.md"); hidden files, links and catalogues do not. Errors: not a folder, not readable, or more
/// than 100 000 files.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> content_in(const std::filesystem::path& folder);

/// Entries and all that they refer to, and so on, of what the catalogue has; by path.
[[nodiscard]] std::vector<CatalogueEntry> with_all_referred(std::span<const CatalogueEntry> all,
                                                            std::vector<CatalogueEntry> wanted);

}  // namespace mechane::content
