// `mechane content export`: a folder of content with a catalogue of its own, which a kiosk can use without the server's folder.
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
  bool replaced = false;  ///< an older export
};

/// Copies the entries' files into `to`, and a catalogue of them as catalogue.db. All is first written to a draft beside it, where each
/// copy's hash is compared with its entry. Only then does the folder get its name: it is whole, or as it was. An empty folder, or an older
/// export that contains nothing else, is replaced in one step. Errors: not_found (a file is gone), conflict (a file has changed; the folder
/// contains something else, or is in the catalogue's own), io_failure (a full disk).
[[nodiscard]] Expected<Exported> export_content(const Catalogue& catalogue, std::span<const CatalogueEntry> entries,
                                                const std::filesystem::path& to);

}  // namespace mechane::content
