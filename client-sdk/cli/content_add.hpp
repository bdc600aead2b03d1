// What `mechane content add` makes of a file.
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

/// Entries of the files and folders that the options name, and of what scenarios among them refer to. `known` is what the catalogue
/// says now: what neither the options nor the file tell stays as it was. Reads every file; writes nothing.
[[nodiscard]] Gathered gather(const ContentOptions& options, const std::filesystem::path& folder,
                              const std::vector<content::CatalogueEntry>& known);

}  // namespace mechane::cli
