#include "client-sdk/cli/content.hpp"

#include <algorithm>
#include <ostream>
#include <set>

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include "client-sdk/cli/content_add.hpp"
#include "client-sdk/cli/content_text.hpp"
#include "server/content/catalogue_check.hpp"
#include "server/content/catalogue_export.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using content::Catalogue;
using content::CatalogueEntry;
using content::CatalogueFault;

/// One run of a verb: where it speaks, and what it was told.
class ContentCommand {
 public:
  ContentCommand(const ContentOptions& options, std::ostream& out, std::ostream& errors)
      : options_(options), out_(out), errors_(errors) {}

  int add();
  int list();
  int show();
  int verify();
  int remove();
  int export_to();

 private:
  int failed(const Error& error) {
    fmt::print(errors_, "mechane content: {}\n", shown(error.to_string()));
    return 1;
  }
  /// The entries that the words name; without words all. An error for a word that names none.
  /// Where `one_each`, also for a word that names several.
  Expected<std::vector<CatalogueEntry>> named(const std::vector<CatalogueEntry>& all, bool one_each = false) const;
  Expected<std::vector<CatalogueEntry>> read(std::optional<Catalogue>& catalogue) const;

  const ContentOptions& options_;
  std::ostream& out_;
  std::ostream& errors_;
};

Expected<std::vector<CatalogueEntry>> ContentCommand::read(std::optional<Catalogue>& catalogue) const {
  auto opened = Catalogue::open(options_.catalogue, Catalogue::Access::read);
  if (!opened) return tl::unexpected(opened.error());
  catalogue.emplace(std::move(*opened));
  return catalogue->entries();
}

Expected<std::vector<CatalogueEntry>> ContentCommand::named(const std::vector<CatalogueEntry>& all,
                                                            bool one_each) const {
  if (options_.words.empty()) return all;
  std::set<std::string> taken;
  std::vector<CatalogueEntry> found;
  for (const std::string& word : options_.words) {
    const std::vector<CatalogueEntry> entries = content::find_entries(all, word);
    if (entries.empty()) {
      return fail("the catalogue has nothing of this name, path or hash", word,
                  "mechane content list shows what it has");
    }
    if (one_each && entries.size() > 1) {
      std::vector<std::string> paths;
      std::ranges::transform(entries, std::back_inserter(paths), &CatalogueEntry::path);
      return fail(fmt::format("it names {} files", paths.size()), word,
                  fmt::format("name one by its path: {}", fmt::join(paths, ", ")));
    }
    for (const CatalogueEntry& entry : entries) {
      if (taken.insert(entry.path).second) found.push_back(entry);
    }
  }
  return found;
}

int ContentCommand::add() {
  auto catalogue = Catalogue::open(options_.catalogue, Catalogue::Access::write);
  if (!catalogue) return failed(catalogue.error());
  const auto known = catalogue->entries();
  if (!known) return failed(known.error());
  const Gathered gathered = gather(options_, catalogue->folder(), *known);
  for (const Error& error : gathered.errors)
    (void)failed(error);
  const auto changes = catalogue->put(gathered.entries);
  if (!changes) return failed(changes.error());
  const auto say = [&](const std::vector<std::string>& paths, const char* what) {
    for (const std::string& path : paths)
      fmt::print(out_, "{:<8} {}\n", what, shown(path));
  };
  say(changes->added, "added");
  say(changes->changed, "changed");
  fmt::print(out_, "{}: {} added, {} changed, {} as they were\n", options_.catalogue.string(), changes->added.size(),
             changes->changed.size(), changes->same);
  return gathered.errors.empty() ? 0 : 1;
}

int ContentCommand::list() {
  if (!options_.kind.empty() && !content::kind_of_word(options_.kind)) {
    fmt::print(errors_,
               "mechane content list: there is no kind '{}'; name scenario, model, part, texture, sound or text\n",
               options_.kind);
    return 2;
  }
  std::optional<Catalogue> catalogue;
  auto entries = read(catalogue);
  if (!entries) return failed(entries.error());
  const auto lacks = [](const std::vector<std::string>& values, const std::string& wanted) {
    return !wanted.empty() && std::ranges::find(values, wanted) == values.end();
  };
  std::erase_if(*entries, [&](const CatalogueEntry& entry) {
    return (!options_.kind.empty() && word_of(entry.kind) != options_.kind) || lacks(entry.tags, options_.tag) ||
           lacks(entry.languages, options_.language);
  });
  std::ranges::stable_sort(*entries, {}, &CatalogueEntry::kind);
  out_ << (options_.json ? entries_json(*entries) : entries_table(*entries));
  return 0;
}

int ContentCommand::show() {
  std::optional<Catalogue> catalogue;
  const auto all = read(catalogue);
  if (!all) return failed(all.error());
  auto entries = named(*all);
  if (!entries) return failed(entries.error());
  std::ranges::stable_sort(*entries, {}, &CatalogueEntry::kind);
  if (options_.json) {
    out_ << entries_json(*entries);
    return 0;
  }
  for (const CatalogueEntry& entry : *entries)
    out_ << (&entry == entries->data() ? "" : "\n") << entry_page(entry, *all);
  return 0;
}

int ContentCommand::verify() {
  std::optional<Catalogue> catalogue;
  const auto entries = read(catalogue);
  if (!entries) return failed(entries.error());
  const auto faults = content::verify(*catalogue);
  if (!faults) return failed(faults.error());
  out_ << (options_.json ? faults_json(*faults) : faults_text(*faults, *entries));
  return std::ranges::all_of(*faults, &CatalogueFault::is_note) ? 0 : 1;
}

int ContentCommand::remove() {
  auto catalogue = Catalogue::open(options_.catalogue, Catalogue::Access::write);
  if (!catalogue) return failed(catalogue.error());
  const auto all = catalogue->entries();
  if (!all) return failed(all.error());
  const auto entries = named(*all, true);
  if (!entries) return failed(entries.error());
  std::vector<std::string> paths;
  for (const CatalogueEntry& entry : *entries)
    paths.push_back(entry.path);
  const auto removed = catalogue->remove(paths);
  if (!removed) return failed(removed.error());
  for (const std::string& path : paths)
    fmt::print(out_, "removed  {}\n", shown(path));
  fmt::print(out_, "{}: {} removed; the files are where they were\n", options_.catalogue.string(), *removed);
  return 0;
}

int ContentCommand::export_to() {
  std::optional<Catalogue> catalogue;
  const auto all = read(catalogue);
  if (!all) return failed(all.error());
  auto wanted = named(*all);
  if (!wanted) return failed(wanted.error());
  const std::vector<CatalogueEntry> entries = content::with_all_referred(*all, std::move(*wanted));
  if (entries.empty())
    return failed({"the catalogue is empty", options_.catalogue.string(), "mechane content add FOLDER"});
  for (const CatalogueEntry& entry : entries) {
    for (const std::string& path : entry.refers_to) {
      if (!std::ranges::binary_search(entries, path, {}, &CatalogueEntry::path))
        return failed({fmt::format("it needs {}, which the catalogue does not know", path), entry.path,
                       "mechane content add " + path});
    }
  }
  const auto done = content::export_content(*catalogue, entries, options_.folder);
  if (!done) return failed(done.error());
  fmt::print(out_, "{}: {} files, {}, each read back and right{}\n", options_.folder, done->files,
             size_text(done->bytes), done->replaced ? "; the older export is gone" : "");
  fmt::print(out_, "on the kiosk: mechane display --catalogue {}\n",
             (fs::path(options_.folder) / content::kCatalogueFileName).string());
  return 0;
}

}  // namespace

int run_content(std::string_view verb, const ContentOptions& options, std::ostream& out, std::ostream& errors) {
  ContentCommand command(options, out, errors);
  if (verb == "add") return command.add();
  if (verb == "list") return command.list();
  if (verb == "show") return command.show();
  if (verb == "verify") return command.verify();
  if (verb == "remove") return command.remove();
  return command.export_to();
}

}  // namespace mechane::cli
