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

/// One run of a verb, with its options and output streams.
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
  [[nodiscard]] std::string command(std::string_view verb, const std::string& word = {}) const {
    return content::content_command(options_.catalogue, verb, word);
  }
  /// An open catalogue, all its entries, and those that the words name (without words: all).
  struct Read {
    Catalogue catalogue;
    std::vector<CatalogueEntry> all;
    std::vector<CatalogueEntry> named;
  };
  /// Errors: no catalogue; a word that names no entry; with `one_each`, also a word that names several.
  Expected<Read> read(Catalogue::Access access = Catalogue::Access::read, bool one_each = false) const;
  Expected<std::vector<CatalogueEntry>> named(const std::vector<CatalogueEntry>& all, bool one_each) const;
  Expected<Gathered> gather_files() const;
  void say_changes(const Catalogue::Changes& changes);

  const ContentOptions& options_;
  std::ostream& out_;
  std::ostream& errors_;
};

Expected<ContentCommand::Read> ContentCommand::read(Catalogue::Access access, bool one_each) const {
  std::error_code code;
  // Only `add` creates a catalogue.
  const bool there = fs::exists(options_.catalogue, code);
  auto catalogue = Catalogue::open(options_.catalogue, there ? access : Catalogue::Access::read);
  if (!catalogue) return tl::unexpected(catalogue.error());
  auto all = catalogue->entries();
  if (!all) return tl::unexpected(all.error());
  auto found = named(*all, one_each);
  if (!found) return tl::unexpected(found.error());
  return Read{std::move(*catalogue), std::move(*all), std::move(*found)};
}

Expected<std::vector<CatalogueEntry>> ContentCommand::named(const std::vector<CatalogueEntry>& all,
                                                            bool one_each) const {
  if (options_.words.empty()) return all;
  std::set<std::string> taken;
  std::vector<CatalogueEntry> found;
  for (const std::string& word : options_.words) {
    const std::vector<CatalogueEntry> entries = content::find_entries(all, word);
    if (entries.empty()) {
      return fail(ErrorCode::unknown_name, "no file in the catalogue has this name, path or hash", word,
                  command("list") + " lists its files");
    }
    if (one_each && entries.size() > 1) {
      std::vector<std::string> paths;
      std::ranges::transform(entries, std::back_inserter(paths), &CatalogueEntry::path);
      return fail(ErrorCode::conflict, fmt::format("this names {} files", paths.size()), word,
                  fmt::format("name one by its path: {}", fmt::join(paths, ", ")));
    }
    for (const CatalogueEntry& entry : entries) {
      if (taken.insert(entry.path).second) found.push_back(entry);
    }
  }
  return found;
}

/// Reads the files first, so that no new catalogue is created if none can be added.
Expected<Gathered> ContentCommand::gather_files() const {
  std::error_code code;
  if (!fs::exists(options_.catalogue, code))
    return gather(options_, content::folder_of_catalogue(options_.catalogue), {});
  const auto catalogue = Catalogue::open(options_.catalogue, Catalogue::Access::write);
  if (!catalogue) return tl::unexpected(catalogue.error());
  const auto known = catalogue->entries();
  if (!known) return tl::unexpected(known.error());
  return gather(options_, catalogue->folder(), *known);
}

void ContentCommand::say_changes(const Catalogue::Changes& changes) {
  const auto say = [&](const std::vector<std::string>& paths, const char* what, const char* more) {
    for (const std::string& path : paths)
      fmt::print(out_, "{:<8} {}{}\n", what, shown(path), more);
  };
  say(changes.added, "added", "");
  say(changes.changed, "changed", "");
  say(changes.retold, "updated", ": the same file, with other information about it");
  fmt::print(out_, "{}: {} added, {} changed, {}{} unchanged\n", options_.catalogue.string(), changes.added.size(),
             changes.changed.size(), changes.retold.empty() ? "" : fmt::format("{} updated, ", changes.retold.size()),
             changes.same);
}

int ContentCommand::add() {
  const auto gathered = gather_files();
  if (!gathered) return failed(gathered.error());
  for (const Error& error : gathered->errors)
    (void)failed(error);
  if (gathered->entries.empty()) return 1;
  auto catalogue = Catalogue::open(options_.catalogue, Catalogue::Access::write);
  if (!catalogue) return failed(catalogue.error());
  const auto changes = catalogue->put(gathered->entries);
  if (!changes) return failed(changes.error());
  say_changes(*changes);
  return gathered->errors.empty() ? 0 : 1;
}

int ContentCommand::list() {
  if (!options_.kind.empty() && !content::kind_of_word(options_.kind)) {
    fmt::print(
        errors_,
        "mechane content list: '{}' is not a kind of content; choose scenario, model, part, texture, sound or text\n",
        options_.kind);
    return 2;
  }
  auto content = read();
  if (!content) return failed(content.error());
  std::vector<CatalogueEntry>& entries = content->all;
  const auto lacks = [](const std::vector<std::string>& values, const std::string& wanted) {
    return !wanted.empty() && std::ranges::find(values, wanted) == values.end();
  };
  std::erase_if(entries, [&](const CatalogueEntry& entry) {
    return (!options_.kind.empty() && word_of(entry.kind) != options_.kind) || lacks(entry.tags, options_.tag) ||
           lacks(entry.languages, options_.language);
  });
  std::ranges::stable_sort(entries, {}, &CatalogueEntry::kind);
  out_ << (options_.json ? entries_json(entries) : entries_table(entries));
  return 0;
}

int ContentCommand::show() {
  auto content = read();
  if (!content) return failed(content.error());
  std::ranges::stable_sort(content->named, {}, &CatalogueEntry::kind);
  if (options_.json) {
    out_ << entries_json(content->named);
    return 0;
  }
  for (const CatalogueEntry& entry : content->named)
    out_ << (&entry == content->named.data() ? "" : "\n") << entry_page(entry, content->all);
  return 0;
}

int ContentCommand::verify() {
  const auto content = read();
  if (!content) return failed(content.error());
  const auto faults = content::verify(content->catalogue);
  if (!faults) return failed(faults.error());
  out_ << (options_.json ? faults_json(*faults) : faults_text(*faults, content->all));
  return std::ranges::all_of(*faults, &CatalogueFault::is_note) ? 0 : 1;
}

int ContentCommand::remove() {
  auto content = read(Catalogue::Access::write, true);
  if (!content) return failed(content.error());
  std::vector<std::string> paths;
  std::ranges::transform(content->named, std::back_inserter(paths), &CatalogueEntry::path);
  const auto removed = content->catalogue.remove(paths);
  if (!removed) return failed(removed.error());
  for (const std::string& path : paths)
    fmt::print(out_, "removed  {}\n", shown(path));
  fmt::print(out_, "{}: {} removed from the catalogue; the files themselves stay\n", options_.catalogue.string(),
             *removed);
  return 0;
}

int ContentCommand::export_to() {
  const auto content = read();
  if (!content) return failed(content.error());
  const std::vector<CatalogueEntry> entries = content::with_all_referred(content->all, content->named);
  if (entries.empty())
    return failed(
        {ErrorCode::missing, "the catalogue is empty", options_.catalogue.string(), command("add", "FOLDER")});
  for (const CatalogueEntry& entry : entries) {
    for (const std::string& path : entry.refers_to) {
      if (!std::ranges::binary_search(entries, path, {}, &CatalogueEntry::path))
        return failed({ErrorCode::missing, fmt::format("it needs {}, which is not in the catalogue", path), entry.path,
                       command("add", path)});
    }
  }
  const auto done = content::export_content(content->catalogue, entries, options_.folder);
  if (!done) return failed(done.error());
  const std::size_t along = entries.size() - content->named.size();
  fmt::print(out_, "{}: {} files, {}, each read back and correct{}\n", options_.folder, done->files,
             size_text(done->bytes), done->replaced ? "; the older export was replaced" : "");
  if (along > 0)
    fmt::print(out_, "{} named, and {} that they refer to: models, sounds, pages, scenarios that their signs open\n",
               content->named.size(), along);
  fmt::print(out_, "on the kiosk: mechane display --catalogue {}\n",
             content::shell_word((fs::path(options_.folder) / content::kCatalogueFileName).string()));
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
