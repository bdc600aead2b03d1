// Makes the catalogue entries for `mechane content add`.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "client-sdk/cli/content.hpp"
#include "server/base/error.hpp"
#include "server/content/catalogue.hpp"

namespace mechane::cli {

struct Gathered {
  std::vector<content::CatalogueEntry> entries;  ///< by path
  std::vector<Error> errors;                     ///< of files that cannot be added
};

/// Entries of the files and folders that the options name, and of the files that scenarios among them refer to. `known`
/// are the catalogue's present entries: what neither the options nor the file give is kept from them. Reads every file;
/// writes nothing.
[[nodiscard]] Gathered gather(const ContentOptions& options, const std::filesystem::path& folder,
                              const std::vector<content::CatalogueEntry>& known);

}  // namespace mechane::cli
