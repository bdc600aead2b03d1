#include "server/content/catalogue_check.hpp"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "server/content/content_command.hpp"
#include "server/content/content_hash.hpp"

namespace mechane::content {
namespace {

namespace fs = std::filesystem;
using Fault = CatalogueFault;

constexpr std::size_t kMostFiles = 100'000;

/// Finds the faults of one catalogue.
class CatalogueCheck {
 public:
  CatalogueCheck(const Catalogue& catalogue, const std::vector<CatalogueEntry>& entries)
      : file_(catalogue.file()), folder_(catalogue.folder()), entries_(entries) {
    for (const CatalogueEntry& entry : entries) {
      by_path_.emplace(entry.path, &entry);
      referred_.insert(entry.refers_to.begin(), entry.refers_to.end());
    }
  }

  Expected<std::vector<Fault>> run() {
    for (const CatalogueEntry& entry : entries_) {
      check_file(entry);
      check_references(entry);
      if (entry.kind == ContentKind::scenario) {
        check_languages(entry);
        check_id(entry);
      }
      if (entry.credits.licence.empty())
        add(Fault::Kind::no_licence, entry.path, "it has no licence",
            command("add", "FILE") + " --licence LICENCE, or write a file LICENCE beside it");
    }
    if (auto ok = check_folder(); !ok) return tl::unexpected(ok.error());
    std::ranges::stable_sort(faults_, {}, &Fault::path);
    return std::move(faults_);
  }

 private:
  void add(Fault::Kind kind, const std::string& path, std::string what, std::string remedy) {
    faults_.push_back({kind, path, std::move(what), std::move(remedy)});
  }

  void check_file(const CatalogueEntry& entry) {
    std::error_code code;
    if (!fs::exists(folder_ / entry.path, code)) {
      add(Fault::Kind::gone, entry.path, "the file is gone",
          "bring it back, or forget it: " + command("remove", entry.path));
      return;
    }
    const Expected<std::string> hash = content_hash(folder_ / entry.path);
    if (!hash) {
      add(Fault::Kind::gone, entry.path, "the file cannot be read: " + hash.error().what, hash.error().remedy);
    } else if (*hash != entry.hash) {
      add(Fault::Kind::changed, entry.path,
          fmt::format("its content has changed since it was added: hash {} instead of {}", short_hash(*hash),
                      short_hash(entry.hash)),
          "restore the file, or if the change was meant: " + command("add", entry.path));
    }
  }

  void check_id(const CatalogueEntry& scenario) {
    for (const CatalogueEntry& other : entries_) {
      if (other.kind != ContentKind::scenario || other.name != scenario.name || other.path >= scenario.path) continue;
      add(Fault::Kind::twice, scenario.path, fmt::format("{} has the same id '{}'", other.path, scenario.name),
          "give one of the two another id, and add it again");
    }
  }

  void check_references(const CatalogueEntry& entry) {
    for (const std::string& path : entry.refers_to) {
      if (by_path_.contains(path)) continue;
      std::error_code code;
      const bool there = is_inside(path) && fs::exists(folder_ / path, code);
      add(Fault::Kind::missing, entry.path,
          fmt::format("it needs {}, which {}", path, there ? "is not in the catalogue" : "does not exist"),
          there ? command("add", path)
                : fmt::format("make the file, or correct its name in {} and: {}", entry.path,
                              command("add", entry.path)));
    }
    if (entry.kind != ContentKind::scenario && !referred_.contains(entry.path)) {
      add(Fault::Kind::orphan, entry.path, "nothing refers to it",
          "use it in a scenario and add the scenario again, or remove the file and: " + command("remove", entry.path));
    }
  }

  void check_languages(const CatalogueEntry& scenario) {
    for (const std::string& language : scenario.languages) {
      std::vector<std::string> lacking;
      for (const auto& [words, said] : scenario.wordings) {
        if (!std::ranges::binary_search(said, language)) lacking.push_back(words);
      }
      if (!lacking.empty()) {
        const std::size_t more = lacking.size() - 1;
        add(Fault::Kind::language, scenario.path,
            fmt::format("these words are missing in '{}': {}{}", language, lacking.front(),
                        more > 0 ? fmt::format(" and {} more", more) : ""),
            command("show", scenario.path) + " lists them; write them and add the scenario again");
      }
    }
    check_pages(scenario);
  }

  /// Pages need not say their language. Where some do, there must be one for each language of the scenario.
  void check_pages(const CatalogueEntry& scenario) {
    std::set<std::string> pages;
    for (const std::string& path : scenario.refers_to) {
      const auto page = by_path_.find(path);
      if (page != by_path_.end() && page->second->kind == ContentKind::text)
        pages.insert(page->second->languages.begin(), page->second->languages.end());
    }
    if (pages.empty()) return;
    for (const std::string& language : scenario.languages) {
      if (pages.contains(language)) continue;
      const std::string stem = fs::path(scenario.path).stem().string();
      add(Fault::Kind::language, scenario.path,
          fmt::format("its page is in {} only, not in '{}'", fmt::join(pages, ", "), language),
          fmt::format("write {}.{}.md beside it and add the scenario again", stem, language));
    }
  }

  Expected<void> check_folder() {
    const auto files = content_in(folder_);
    if (!files) return tl::unexpected(files.error());
    for (const fs::path& file : *files) {
      const std::string path = file.lexically_relative(folder_).generic_string();
      if (!by_path_.contains(path))
        add(Fault::Kind::unknown, path, "the file is not in the catalogue",
            command("add", path) + ", or remove the file");
    }
    return {};
  }

  /// A command for a remedy.
  [[nodiscard]] std::string command(std::string_view verb, const std::string& word) const {
    return content_command(file_, verb, word);
  }

  const fs::path& file_;
  const fs::path& folder_;
  const std::vector<CatalogueEntry>& entries_;
  std::map<std::string, const CatalogueEntry*> by_path_;
  std::set<std::string> referred_;
  std::vector<Fault> faults_;
};

bool has_scenario_beside(const fs::path& text) {
  fs::path stem = text.stem();
  std::error_code code;
  for (int i = 0; i < 2; ++i, stem = stem.stem()) {  // "screw.md", "screw.el.md"
    if (fs::is_regular_file(text.parent_path() / (stem.string() + ".x3d"), code)) return true;
  }
  return false;
}

}  // namespace

std::string_view word_of(Fault::Kind kind) {
  static constexpr std::array<std::string_view, 8> kWords{"changed", "gone",    "missing", "language",
                                                          "orphan",  "unknown", "twice",   "no licence"};
  return kWords[static_cast<std::size_t>(kind)];
}

Expected<std::vector<Fault>> verify(const Catalogue& catalogue) {
  const auto entries = catalogue.entries();
  if (!entries) return tl::unexpected(entries.error());
  return CatalogueCheck(catalogue, *entries).run();
}

Expected<std::vector<fs::path>> content_in(const fs::path& folder) {
  std::error_code code;
  std::vector<fs::path> found;
  std::size_t seen = 0;
  fs::recursive_directory_iterator at(fs::absolute(folder, code).lexically_normal(), code);
  for (const fs::recursive_directory_iterator end; !code && at != end; at.increment(code)) {
    if (++seen > kMostFiles)
      return fail(ErrorCode::too_large, fmt::format("the folder has more than {} files", kMostFiles), folder.string(),
                  "keep content and its catalogue in a folder of their own");
    const bool hidden = at->path().filename().string().starts_with('.');
    if (hidden && at->is_directory(code)) at.disable_recursion_pending();
    if (hidden || at->is_symlink(code) || !at->is_regular_file(code)) continue;
    const auto kind = kind_of_file(at->path());
    if (!kind || (*kind == ContentKind::text && !has_scenario_beside(at->path()))) continue;
    found.push_back(at->path());
  }
  if (code) return fail(ErrorCode::io_failure, code.message(), folder.string(), "check the folder and its rights");
  std::ranges::sort(found);
  return found;
}

std::vector<CatalogueEntry> with_all_referred(std::span<const CatalogueEntry> all, std::vector<CatalogueEntry> wanted) {
  std::map<std::string, const CatalogueEntry*> by_path;
  for (const CatalogueEntry& entry : all)
    by_path.emplace(entry.path, &entry);
  std::set<std::string> taken;
  for (const CatalogueEntry& entry : wanted)
    taken.insert(entry.path);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const std::vector<std::string> next = wanted[i].refers_to;  // a copy: `wanted` grows
    for (const std::string& path : next) {
      const auto entry = by_path.find(path);
      if (entry != by_path.end() && taken.insert(path).second) wanted.push_back(*entry->second);
    }
  }
  std::ranges::sort(wanted, {}, &CatalogueEntry::path);
  return wanted;
}

}  // namespace mechane::content
