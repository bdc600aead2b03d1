// The shelf as the museum's catalogue: what there is, who uses it, what is said of it, and copies of it for a draft.
#include <algorithm>
#include <chrono>
#include <set>

#include <fmt/format.h>

#include "client-sdk/studio/draft/bundle.hpp"
#include "client-sdk/studio/edits/parts.hpp"
#include "client-sdk/studio/shelf/shelf.hpp"
#include "client-sdk/studio/shelf/shelf_text.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/catalogue_check.hpp"
#include "server/content/licence_note.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

std::optional<ItemKind> kind_of_content(const fs::path& file) {
  const auto kind = content::kind_of_file(file);
  if (kind == content::ContentKind::model) return ItemKind::mesh;
  if (kind == content::ContentKind::sound) return ItemKind::sound;
  return std::nullopt;
}

/// What follows the first folder.
fs::path below_first(const fs::path& path) {
  return path.lexically_relative(*path.begin());
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return error ? 0 : size;
}

tl::unexpected<ShelfFault> no_such_file(const std::string& path) {
  return shelf_fault({ErrorCode::not_found, "the museum has no such mesh or sound", path, "take one of the catalogue"});
}

}  // namespace

const ExhibitFacts& Shelf::facts_of(const std::string& name, bool drafted) {
  const fs::path file = drafted ? state_ / name / "draft.x3d" : exhibit_file(name);
  std::error_code error;
  const auto changed = fs::last_write_time(file, error);
  const std::uintmax_t size = error ? 0 : fs::file_size(file, error);
  KnownFile& known = known_[file];
  // One that was read as soon as it was written may have been written again, at what its clock takes for the same time.
  constexpr auto kSettled = std::chrono::seconds(2);
  if (!error && known.changed == changed && known.size == size && changed + kSettled < known.read) return known.facts;
  known = {changed, fs::file_time_type::clock::now(), size, {}};
  if (error) return known.facts;
  x3d::Problems problems(file.string());
  if (const auto document = x3d::read_document(file, problems)) known.facts = exhibit_facts(*document, name);
  return known.facts;
}

std::vector<std::string> Shelf::all_names() const {
  std::vector<std::string> names = draft_names(), exhibits = exhibit_names();
  names.insert(names.end(), exhibits.begin(), exhibits.end());
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Shelf::FileUses Shelf::all_uses() {
  FileUses uses;
  for (const std::string& name : all_names())
    for (const bool drafted : {true, false})
      for (const NamedPath& one : facts_of(name, drafted).uses) {
        std::vector<FileUse>& list = uses[one.path];
        const bool told = !drafted && std::ranges::any_of(list, [&](const FileUse& use) {
          return use.exhibit == name && use.place == one.place;
        });
        if (!told) list.push_back({one.place, one.line, name, drafted, one.language});
      }
  return uses;
}

fs::path Shelf::museum_file(const std::string& path) const {
  const fs::path inside(path);
  const auto is_hidden = [](const fs::path& part) { return part.string().starts_with('.'); };
  if (!content::is_inside(path) || std::ranges::any_of(inside, is_hidden)) return {};
  const fs::path below = below_first(inside);
  const bool own =
      is_exhibit_name(inside.begin()->string()) && is_own_path(below) && is_file_name(below.filename().string());
  if (!own && !kind_of_content(inside)) return {};
  if (fs::path drafted = own ? own_file(state_ / *inside.begin(), below) : fs::path(); !drafted.empty()) return drafted;
  std::error_code unknown;
  return fs::is_regular_file(scenarios_ / inside, unknown) ? scenarios_ / inside : fs::path();
}

Record Shelf::about_file(const std::string& path, const RecordMap& records, const FileUses& uses) const {
  const auto written = records.find(path);
  Record about = written == records.end() ? Record() : written->second;
  const fs::path file = scenarios_ / path;
  std::error_code unknown;
  // A draft's own file is not of whom the museum's folder is.
  for (fs::path folder = file.parent_path(); about.credits.licence.empty() && fs::is_regular_file(file, unknown);
       folder = folder.parent_path()) {
    const content::Credits note = content::read_licence_note(folder);
    about.credits.licence = note.licence;
    if (about.credits.author.empty()) about.credits.author = note.author;
    if (folder == scenarios_) break;
  }
  if (!about.languages.empty() || !uses.contains(path)) return about;
  std::set<std::string> spoken;
  for (const FileUse& use : uses.at(path))
    if (!use.language.empty()) spoken.insert(use.language);
  about.languages.assign(spoken.begin(), spoken.end());
  return about;
}

void Shelf::add_exhibit_items(std::vector<CatalogueItem>& items) {
  const std::vector<std::string> drafts = draft_names(), exhibits = exhibit_names();
  for (const std::string& name : all_names()) {
    const bool drafted = std::ranges::binary_search(drafts, name);
    const ExhibitFacts& facts = facts_of(name, drafted);
    CatalogueItem& item = items.emplace_back();
    item.name = item.exhibit = name;
    item.path = fmt::format("{0}/{0}.x3d", name);
    item.title = facts.title;
    item.bytes = size_of(drafted ? state_ / name / "draft.x3d" : exhibit_file(name));
    item.published = std::ranges::binary_search(exhibits, name);
    item.draft = drafted;
    item.about = facts.about;
    item.words = facts.names;
  }
  const auto add_from_library = [&items](ItemKind kind, const auto& one) {
    CatalogueItem& item = items.emplace_back();
    item.kind = kind;
    item.name = one.name;
    item.title = {{"el", std::string(one.title_el)}, {"en", std::string(one.title_en)}};
    if (kind == ItemKind::a_template) item.about.languages = {"el", "en"};
  };
  for (const Template& one : templates())
    add_from_library(ItemKind::a_template, one);
  for (const Part& one : parts())
    add_from_library(ItemKind::part, one);
}

void Shelf::add_file_items(const FileUses& uses, std::vector<CatalogueItem>& items) const {
  std::set<std::string> known;
  const auto add = [&](ItemKind kind, const fs::path& path, const std::string& exhibit, std::uintmax_t bytes,
                       bool published) {
    if (!known.insert(path.generic_string()).second) return;
    CatalogueItem& item = items.emplace_back();
    item.kind = kind;
    item.name = path.filename().string();
    item.path = path.generic_string();
    item.exhibit = exhibit;
    item.bytes = bytes;
    item.published = published;
  };
  for (const std::string& name : all_names())
    for (const DraftFile& file : files_of(name).names())
      add(file.sound ? ItemKind::sound : ItemKind::mesh, fs::path(name) / kFilesFolder / file.name, name, file.bytes,
          file.published);
  const auto add_shared = [&](const fs::path& path) {
    const auto kind = kind_of_content(path);
    const fs::path file = kind ? museum_file(path.generic_string()) : fs::path();
    if (!file.empty()) add(*kind, path, "", size_of(file), true);
  };
  const auto found = content::content_in(scenarios_);
  for (const fs::path& file : found ? *found : std::vector<fs::path>())
    add_shared(file.lexically_relative(fs::absolute(scenarios_).lexically_normal()));
  for (const auto& [path, users] : uses)
    add_shared(path);
}

ShelfResult<std::string> Shelf::catalogue(const CatalogueQuery& query) {
  if (auto right = check_query(query); !right) return shelf_fault(right.error());
  const auto records = records_.all();
  FileUses uses = all_uses();
  std::vector<CatalogueItem> items;
  add_exhibit_items(items);
  add_file_items(uses, items);
  for (CatalogueItem& item : items) {
    const bool file = item.kind == ItemKind::mesh || item.kind == ItemKind::sound;
    if (file) item.about = about_file(item.path, records ? *records : RecordMap(), uses);
    if (!item.path.empty()) item.uses = uses[item.path];
  }
  std::ranges::stable_sort(items, {}, &CatalogueItem::kind);
  return catalogue_json(items, query, records ? nullptr : &records.error());
}

ShelfResult<std::string> Shelf::describe(const AboutRequest& request) {
  if (museum_file(request.path).empty()) return no_such_file(request.path);
  const auto records = records_.all();
  if (!records) return shelf_fault(records.error());
  const bool other = request.before && *request.before != about_file(request.path, *records, all_uses());
  if (other)
    return shelf_fault({ErrorCode::conflict, "somebody else has written of this file meanwhile", request.path,
                        "look at what is written now, and change it again"});
  if (auto put = records_.put({{request.path, request.about}}); !put) return shelf_fault(put.error());
  return shelf_text({{"path", request.path}, {"about", json_of(request.about)}});
}

void Shelf::copy_records(const std::string& to, const std::map<std::string, std::string>& names) {
  const auto records = records_.all();
  if (!records) return;  // the catalogue tells it
  const FileUses uses = all_uses();
  RecordMap copies;
  for (const auto& [name, from] : names) {
    const std::string path = fmt::format("{}/{}/{}", to, kFilesFolder, name);
    if (path != from && !records->contains(path)) copies[path] = about_file(from, *records, uses);
  }
  (void)records_.put(copies);
}

ShelfResult<std::string> Shelf::take_file(const std::string& name, const std::string& path) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  const fs::path from = museum_file(path);
  if (from.empty()) return no_such_file(path);
  const DraftFiles files = files_of(name);
  const std::string taken = free_file_name(from, [&](const std::string& one) { return !files.has_other(one, from); });
  const auto bytes = read_whole(from, DraftFiles::kMostBytes);
  if (!bytes) return shelf_fault(bytes.error());
  if (auto put = files.put(taken, *bytes, false); !put) return shelf_fault(put.error());
  copy_records(name, {{taken, path}});
  (*opened)->checked = -1;
  auto listed = this->files(name);
  if (!listed) return listed;
  ShelfJson answer = ShelfJson::parse(*listed);
  answer["taken"] = taken;
  return shelf_text(answer);
}

}  // namespace mechane::studio
