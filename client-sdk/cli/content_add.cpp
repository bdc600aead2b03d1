#include "client-sdk/cli/content_add.hpp"

#include <algorithm>
#include <deque>

#include <fmt/format.h>

#include "server/content/catalogue_check.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/licence_note.hpp"
#include "server/content/mesh_import.hpp"
#include "server/content/model_references.hpp"
#include "server/scenario/facts.hpp"

namespace mechane::cli {
namespace {

namespace fs = std::filesystem;
using content::CatalogueEntry;
using content::ContentKind;

/// "el" for "screw.el.md"; empty where the name has no language.
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
      const auto language = languages_.find(path);  // given by the scenario that uses the sound
      if (language != languages_.end() && entry.languages.empty()) entry.languages = {language->second};
      result_.entries.push_back(std::move(entry));
    }
    return std::move(result_);
  }

 private:
  struct Waiting {
    fs::path file;
    bool named = true;  ///< by a person, so that the options apply to it
  };

  void take_word(const std::string& word) {
    std::error_code code;
    // A path from the catalogue's folder, as `verify` prints it, is accepted as well.
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
      result_.errors.push_back({ErrorCode::not_found, "nothing in this folder is content of an exhibit", word,
                                "name a folder with scenarios, models or sounds"});
    } else {
      for (const fs::path& file : *files)
        waiting_.push_back({file});
    }
  }

  void take_file(const Waiting& next) {
    std::error_code code;
    if (!fs::exists(next.file, code)) {
      result_.errors.push_back({ErrorCode::not_found, "the file does not exist", next.file.string(), "check its name"});
      return;
    }
    const auto path = content::path_inside(folder_, next.file);
    if (!path) {
      result_.errors.push_back(path.error());
      return;
    }
    if (made_.contains(*path)) return;
    if (fs::is_symlink(next.file, code)) {
      result_.errors.push_back(
          {ErrorCode::not_supported,
           "this is a link, and an export or another machine would not have the file that it leads to",
           next.file.string(), "put a copy of the file here, or name the file itself"});
      return;
    }
    auto entry = entry_of(next, *path);
    if (entry) {
      made_.emplace(*path, std::move(*entry));
    } else {
      result_.errors.push_back(entry.error());
    }
  }

  Expected<CatalogueEntry> entry_of(const Waiting& next, const std::string& path) {
    auto kind = content::kind_of_file(next.file);
    if (!kind && content::is_piece_of_model(next.file)) kind = ContentKind::model;
    if (!kind) {
      return fail(ErrorCode::not_supported, "a catalogue does not keep this kind of file", next.file.string(),
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
    if (entry.bytes == 0) return fail(ErrorCode::damaged, "the file is empty", next.file.string(), "make it again");
    entry.refers_to.clear();
    entry.wordings.clear();
    if (*kind == ContentKind::scenario) {
      if (auto ok = take_facts(next.file, entry); !ok) return tl::unexpected(ok.error());
    } else if (const std::string language = language_in_name(next.file); !language.empty()) {
      entry.languages = {language};
    }
    if (*kind == ContentKind::model && !content::is_piece_of_model(next.file)) {
      const bool as_it_was = old != known_.end() && old->second.hash == entry.hash;
      if (auto ok = take_model(next.file, as_it_was, entry); !ok) return tl::unexpected(ok.error());
    }
    if (next.named) take_options(entry);
    take_licence_beside(next.file, entry);
    return entry;
  }

  /// Checks that server and displays can read the model, and adds the files that it refers to.
  Expected<void> take_model(const fs::path& file, bool as_it_was, CatalogueEntry& entry) {
    if (!as_it_was) {
      if (const auto scene = content::import_mesh(file); !scene) return tl::unexpected(scene.error());
    }
    const auto others = content::files_of_model(file);
    if (!others) return tl::unexpected(others.error());
    for (const std::string& name : *others) {
      if (!content::kind_of_file(name) && !content::is_piece_of_model(name)) continue;
      if (auto ok = refer_to(file.parent_path() / name, entry); !ok) return tl::unexpected(ok.error());
    }
    refer_to_beside(file, entry, [&](const fs::path& other) {
      return content::kind_of_file(other) == ContentKind::part && other.stem() == file.stem();
    });
    return {};
  }

  /// Adds a reference to a file that `entry` names. The file may be missing: verify reports this.
  Expected<void> refer_to(const fs::path& other, CatalogueEntry& entry, const std::string& language = {}) {
    const auto path = content::path_inside(folder_, other);
    if (!path) return tl::unexpected(path.error());
    entry.refers_to.push_back(*path);
    if (!language.empty()) languages_.emplace(*path, language);
    std::error_code code;
    if (fs::exists(other, code)) waiting_.push_back({other, false});
    return {};
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
      if (auto ok = refer_to(file.parent_path() / url, entry, language); !ok) return tl::unexpected(ok.error());
    }
    const std::string stem = file.stem().string();
    refer_to_beside(file, entry, [&](const fs::path& other) {
      return content::kind_of_file(other) == ContentKind::text &&
             (other.stem() == stem || (other.stem().stem() == stem && !language_in_name(other).empty()));
    });
    return {};
  }

  /// Adds a reference to a scenario to which visitors go on from `entry`. It may be missing: visitors then stay.
  void refer_to_scenario(CatalogueEntry& entry, const std::string& id) const {
    for (const auto* entries : {&made_, &known_}) {
      for (const auto& [path, other] : *entries) {
        if (other.kind != ContentKind::scenario || other.name != id || path == entry.path) continue;
        entry.refers_to.push_back(path);
        return;
      }
    }
  }

  /// Adds references to a scenario's pages, or a model's parts: files beside it with the same name.
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

  /// Takes credits that neither a person nor the file gives from the nearest LICENCE, up to the catalogue's folder.
  void take_licence_beside(const fs::path& file, CatalogueEntry& entry) {
    if (!entry.credits.licence.empty()) return;
    std::error_code code;
    fs::path at = fs::weakly_canonical(fs::absolute(file, code), code).parent_path();
    for (; content::is_inside((at / "x").lexically_relative(folder_).generic_string()); at = at.parent_path()) {
      auto note = notes_.find(at);
      if (note == notes_.end()) note = notes_.emplace(at, content::read_licence_note(at)).first;
      if (note->second.licence.empty()) continue;
      entry.credits.licence = note->second.licence;
      if (entry.credits.author.empty()) entry.credits.author = note->second.author;
      return;
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
  std::map<fs::path, content::Credits> notes_;      ///< from the LICENCE of each folder, as far as read
  Gathered result_;
};

}  // namespace

Gathered gather(const ContentOptions& options, const fs::path& folder, const std::vector<CatalogueEntry>& known) {
  return Gatherer(options, folder, known).run();
}

}  // namespace mechane::cli
