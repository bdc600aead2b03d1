// `mechane content export`: a folder that a kiosk can use without the server's, with a catalogue of its own.
#pragma once

#include <filesystem>
#include <span>

#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::content {

inline constexpr const char* kCatalogueFileName = "catalogue.db";

struct Exported {
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  bool replaced = false;  ///< an older export stood there
};

/// Copies the entries' files into `to`, and a catalogue of them as catalogue.db. All is written aside, each copy's hash is held against
/// its entry, and only then the folder gets its name: it is whole or as it was. An empty folder, or an older export that holds nothing
/// else, is replaced in one step. Errors: a file that is gone or not what its entry says, a folder that holds something else or is in the catalogue's own, a full
/// disk.
[[nodiscard]] Expected<Exported> export_content(const Catalogue& catalogue, std::span<const CatalogueEntry> entries,
                                                const std::filesystem::path& to);

}  // namespace mechane::content
