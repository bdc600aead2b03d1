// How `mechane content` writes entries and faults, for people and for programs.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "server/content/catalogue.hpp"
#include "server/content/catalogue_check.hpp"

namespace mechane::cli {

/// Text from a file as a terminal may show it: control characters, which could drive the terminal, are '?'.
[[nodiscard]] std::string shown(std::string text);
/// "812 B", "5.4 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// A line an entry under a head, and a last line that counts them.
[[nodiscard]] std::string entries_table(std::span<const content::CatalogueEntry> entries);
/// All that is known of one entry; `all` tells what uses it.
[[nodiscard]] std::string entry_page(const content::CatalogueEntry& entry,
                                     std::span<const content::CatalogueEntry> all);
/// An array of objects with the fields of CatalogueEntry.
[[nodiscard]] std::string entries_json(std::span<const content::CatalogueEntry> entries);

/// A line a fault, notes of one kind in one line, and a last line that counts.
[[nodiscard]] std::string faults_text(std::span<const content::CatalogueFault> faults,
                                      std::span<const content::CatalogueEntry> entries);
[[nodiscard]] std::string faults_json(std::span<const content::CatalogueFault> faults);

}  // namespace mechane::cli
