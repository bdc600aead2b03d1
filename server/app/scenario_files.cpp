#include "server/app/scenario_files.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "server/content/catalogue.hpp"
#include "server/content/catalogue_check.hpp"
#include "server/content/content_command.hpp"
#include "server/content/content_hash.hpp"
#include "server/log/log.hpp"

namespace mechane::app {
namespace {

namespace fs = std::filesystem;
using content::CatalogueEntry;
using content::ContentKind;

Expected<fs::path> file_of(const fs::path& name, const std::vector<CatalogueEntry>& entries,
                           const content::Catalogue& catalogue) {
  std::error_code code;
  if (fs::exists(name, code) && !fs::is_directory(name, code)) return name;
  std::vector<std::string> ids, paths;
  for (const CatalogueEntry& entry : entries) {
    if (entry.kind != ContentKind::scenario) continue;
    if (entry.name == name.string()) paths.push_back(entry.path);
    ids.push_back(entry.name);
  }
  if (paths.size() == 1) return catalogue.folder() / paths.front();
  if (paths.size() > 1) {
    return fail(ErrorCode::duplicate,
                fmt::format("the catalogue has {} scenarios with the id '{}'", paths.size(), name.string()),
                catalogue.file().string(), fmt::format("name one of their files: {}", fmt::join(paths, ", ")));
  }
  return fail(ErrorCode::unknown_name,
              fmt::format("'{}' is neither a file nor a scenario in the catalogue", name.string()),
              catalogue.file().string(), fmt::format("name one of: {}", fmt::join(ids, ", ")));
}

/// Logs a line where the file is not what the catalogue says.
void warn_if_changed(const CatalogueEntry& entry, const content::Catalogue& catalogue) {
  const fs::path file = catalogue.folder() / entry.path;
  const auto hash = content::content_hash(file);
  if (!hash) {
    log::warning(hash.error().to_string());
  } else if (*hash != entry.hash) {
    log::warning(fmt::format("{}: the file has changed since it was added to the catalogue; {} shows how",
                             file.string(), content::content_command(catalogue.file(), "verify")));
  }
}

}  // namespace

Expected<std::vector<fs::path>> find_scenarios(std::span<const fs::path> names, const fs::path& catalogue_file) {
  std::vector<fs::path> files(names.begin(), names.end());
  if (catalogue_file.empty()) return files;
  const auto catalogue = content::Catalogue::open(catalogue_file, content::Catalogue::Access::read);
  if (!catalogue) return tl::unexpected(catalogue.error());
  const auto entries = catalogue->entries();
  if (!entries) return tl::unexpected(entries.error());
  std::vector<CatalogueEntry> used;
  for (fs::path& file : files) {
    auto found = file_of(file, *entries, *catalogue);
    if (!found) return tl::unexpected(found.error());
    file = std::move(*found);
    const auto path = content::path_inside(catalogue->folder(), file);
    const auto entry = std::ranges::find(*entries, path.value_or(""), &CatalogueEntry::path);
    if (entry == entries->end()) {
      log::warning(fmt::format("{}: the file is not in the catalogue; add it with: {}", file.string(),
                               content::content_command(catalogue->file(), "add", file.string())));
    } else {
      used.push_back(*entry);
    }
  }
  for (const CatalogueEntry& entry : content::with_all_referred(*entries, std::move(used)))
    warn_if_changed(entry, *catalogue);
  return files;
}

}  // namespace mechane::app
