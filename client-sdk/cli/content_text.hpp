// The output of `mechane content`: entries and faults, for people and for programs; and words that other commands use
// too.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "server/content/catalogue.hpp"
#include "server/content/catalogue_check.hpp"

namespace mechane::cli {

/// Text from a file, safe for a terminal: '?' replaces control characters.
[[nodiscard]] std::string shown(const std::string& text);
/// The same; a dash where it is empty.
[[nodiscard]] std::string or_dash(const std::string& text);
/// "1 file", "2 files".
[[nodiscard]] std::string count_text(std::size_t number, const char* one, const char* more);
/// "812 B", "5.4 MB".
[[nodiscard]] std::string size_text(std::uint64_t bytes);

/// A header, one line per entry, and a last line with their number.
[[nodiscard]] std::string entries_table(std::span<const content::CatalogueEntry> entries);
/// All that is known of one entry; `all` shows what uses it.
[[nodiscard]] std::string entry_page(const content::CatalogueEntry& entry,
                                     std::span<const content::CatalogueEntry> all);
/// An array of objects with the fields of CatalogueEntry.
[[nodiscard]] std::string entries_json(std::span<const content::CatalogueEntry> entries);

/// One line per fault, notes of one kind in one line, and a last line with the counts.
[[nodiscard]] std::string faults_text(std::span<const content::CatalogueFault> faults,
                                      std::span<const content::CatalogueEntry> entries);
[[nodiscard]] std::string faults_json(std::span<const content::CatalogueFault> faults);

}  // namespace mechane::cli
