#include "client-sdk/cli/content_add.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "server/content/catalogue_check.hpp"
#include "server/content/content_hash.hpp"
#include "server/scenario/facts.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using content::CatalogueEntry;
using content::ContentKind;

/// "el" of "screw.el.md"; empty where there is none.
std::string language_in_name(const fs::path& file) {
  const std::string code = file.stem().extension().string();
  const bool language =
      code.size() == 3 && std::ranges::all_of(code.substr(1), [](char c) { return c >= 'a' && c <= 'z'; });
  return language ? code.substr(1) : "";
}

class Gatherer {
 public:
  Gatherer(const ContentOptions& options, const fs::path& folder, const std::vector<CatalogueEntry>& known)
      : options_(options), folder_(folder) {
    for (const CatalogueEntry& entry : known)
      known_.emplace(entry.path, entry);
  }

  Gathered run() {
    for (const std::string& word : options_.words)
      take_word(word);
    while (!waiting_.empty()) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      take_file(next);
    }
    for (const auto& [path, id] : opened_) {
      const auto entry = made_.find(path);
      if (entry != made_.end()) refer_to_scenario(entry->second, id);
    }
    for (auto& [path, entry] : made_) {
      const auto language = languages_.find(path);  // what a scenario says of its sound
      if (language != languages_.end() && entry.languages.empty()) entry.languages = {language->second};
      result_.entries.push_back(std::move(entry));
    }
    return std::move(result_);
  }

 private:
  struct Waiting {
    fs::path file;
    bool named = true;  ///< by a person: the options are meant for it
  };

  void take_word(const std::string& word) {
    std::error_code code;
    // A path as `verify` writes it will do as well: from the catalogue's folder.
    if (!fs::exists(word, code) && content::is_inside(word) && fs::exists(folder_ / word, code)) {
      waiting_.push_back({folder_ / word});
      return;
    }
    if (!fs::is_directory(word, code)) {
      waiting_.push_back({word});
      return;
    }
    const auto files = content::content_in(word);
    if (!files) {
      result_.errors.push_back(files.error());
    } else if (files->empty()) {
      result_.errors.push_back(
          {"there is no content in this folder", word, "name a folder with scenarios, models, sounds"});
    } else {
      for (const fs::path& file : *files)
        waiting_.push_back({file});
    }
  }

  void take_file(const Waiting& next) {
    std::error_code code;
    if (!fs::exists(next.file, code)) {
      result_.errors.push_back({"there is no such file", next.file.string(), "check its name"});
      return;
    }
    const auto path = content::path_inside(folder_, next.file);
    if (!path) {
      result_.errors.push_back(path.error());
      return;
    }
    if (made_.contains(*path)) return;
    auto entry = entry_of(next, *path);
    if (entry) {
      made_.emplace(*path, std::move(*entry));
    } else {
      result_.errors.push_back(entry.error());
    }
  }

  Expected<CatalogueEntry> entry_of(const Waiting& next, const std::string& path) {
    const auto kind = content::kind_of_file(next.file);
    if (!kind) {
      return fail("this is no content", next.file.string(),
                  "content is .x3d, .glb .gltf .obj .stl .ply, .part, .png .jpg .ktx2, .ogg .opus .wav .flac .mp3, .md "
                  ".html .vtt");
    }
    CatalogueEntry entry;
    const auto old = known_.find(path);
    if (old != known_.end()) entry = old->second;
    entry.path = path;
    entry.kind = *kind;
    entry.name = next.file.stem().string();
    auto hash = content::content_hash(next.file);
    if (!hash) return tl::unexpected(hash.error());
    entry.hash = std::move(*hash);
    std::error_code code;
    entry.bytes = fs::file_size(next.file, code);
    entry.refers_to.clear();
    entry.wordings.clear();
    if (*kind == ContentKind::scenario) {
      if (auto ok = take_facts(next.file, entry); !ok) return tl::unexpected(ok.error());
    } else if (const std::string language = language_in_name(next.file); !language.empty()) {
      entry.languages = {language};
    }
    if (*kind == ContentKind::model)
      refer_to_beside(next.file, entry, [&](const fs::path& other) {
        return content::kind_of_file(other) == ContentKind::part && other.stem() == next.file.stem();
      });
    if (next.named) take_options(entry);
    return entry;
  }

  Expected<void> take_facts(const fs::path& file, CatalogueEntry& entry) {
    const auto facts = scenario::read_facts(file);
    if (!facts) return tl::unexpected(facts.error());
    if (!facts->id.empty()) entry.name = facts->id;
    take_credits(facts->credits, entry);
    entry.tags.insert(entry.tags.end(), facts->tags.begin(), facts->tags.end());
    entry.titles = facts->titles;
    entry.languages = facts->languages;
    entry.wordings = facts->wordings;
    for (const std::string& id : facts->opens)
      opened_.emplace(entry.path, id);
    for (const auto& [url, language] : facts->files) {
      if (!content::kind_of_file(url)) continue;
      const fs::path other = file.parent_path() / url;
      const auto path = content::path_inside(folder_, other);
      if (!path) return tl::unexpected(path.error());
      entry.refers_to.push_back(*path);
      if (!language.empty()) languages_.emplace(*path, language);
      std::error_code code;
      if (fs::exists(other, code)) waiting_.push_back({other, false});  // verify says what is not there
    }
    const std::string stem = file.stem().string();
    refer_to_beside(file, entry, [&](const fs::path& other) {
      return content::kind_of_file(other) == ContentKind::text &&
             (other.stem() == stem || (other.stem().stem() == stem && !language_in_name(other).empty()));
    });
    return {};
  }

  /// A scenario to which visitors go on from `entry`. Where there is none of that id they stay, so it may be absent.
  void refer_to_scenario(CatalogueEntry& entry, const std::string& id) const {
    for (const auto* entries : {&made_, &known_}) {
      for (const auto& [path, other] : *entries) {
        if (other.kind != ContentKind::scenario || other.name != id || path == entry.path) continue;
        entry.refers_to.push_back(path);
        return;
      }
    }
  }

  /// A scenario's pages, a model's parts: they lie beside it under its name.
  template <class Fits>
  void refer_to_beside(const fs::path& file, CatalogueEntry& entry, const Fits& fits) {
    std::error_code code;
    const fs::path parent = fs::absolute(file, code).lexically_normal().parent_path();
    for (fs::directory_iterator at(parent, code), end; !code && at != end; at.increment(code)) {
      if (!fits(at->path()) || !at->is_regular_file(code)) continue;
      const auto path = content::path_inside(folder_, at->path());
      if (!path) continue;
      entry.refers_to.push_back(*path);
      waiting_.push_back({at->path(), false});
    }
  }

  static void take_credits(const content::Credits& from, CatalogueEntry& entry) {
    for (std::string content::Credits::*part : {&content::Credits::licence, &content::Credits::source,
                                                &content::Credits::author, &content::Credits::version}) {
      if (!(from.*part).empty()) entry.credits.*part = from.*part;
    }
  }

  void take_options(CatalogueEntry& entry) const {
    take_credits(options_.credits, entry);
    entry.tags.insert(entry.tags.end(), options_.tags.begin(), options_.tags.end());
    if (!options_.languages.empty()) entry.languages = options_.languages;
  }

  const ContentOptions& options_;
  const fs::path& folder_;
  std::map<std::string, CatalogueEntry> known_;
  std::deque<Waiting> waiting_;
  std::map<std::string, CatalogueEntry> made_;
  std::multimap<std::string, std::string> opened_;  ///< ids of scenarios, by the path of the one that opens them
  std::map<std::string, std::string> languages_;    ///< of sounds, by path
  Gathered result_;
};

}  // namespace

Gathered gather(const ContentOptions& options, const fs::path& folder, const std::vector<CatalogueEntry>& known) {
  return Gatherer(options, folder, known).run();
}

}  // namespace mechane::cli
