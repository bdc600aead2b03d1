#include "client-sdk/studio/shelf/shelf.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "client-sdk/authoring/editor.hpp"
#include "client-sdk/studio/draft/draft_loader.hpp"
#include "client-sdk/studio/draft/preview_file.hpp"
#include "client-sdk/studio/edits/begin_at.hpp"
#include "client-sdk/studio/edits/parts.hpp"
#include "client-sdk/studio/shelf/shelf_text.hpp"
#include "client-sdk/studio/view/view.hpp"
#include "server/base/whole_file.hpp"
#include "server/content/content_hash.hpp"
#include "server/scenario/checker.hpp"
#include "server/scenario/file_finder.hpp"
#include "server/scenario/mesh_finder.hpp"

namespace mechane::studio {
namespace {

namespace fs = std::filesystem;

ShelfJson title_json(const state::Texts& title) {
  ShelfJson out = ShelfJson::object();
  for (const auto& [language, text] : title)
    out[language] = text;
  return out;
}

std::string published() {
  return shelf_text({{"published", true}});
}

/// Nothing needs it: where it cannot be copied, the exhibit keeps the one that it had.
void copy_picture(const fs::path& draft, const fs::path& exhibit) {
  if (const auto picture = read_whole(draft / kPictureFile, Shelf::kMostPictureBytes))
    (void)write_whole(exhibit / kPictureFile, *picture, WholeFile::document);
}

std::vector<std::string> folders_in(const fs::path& folder, const auto& holds) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, missing)) {
    const std::string name = entry.path().filename().string();
    if (is_exhibit_name(name) && holds(entry.path(), name)) names.push_back(name);
  }
  std::ranges::sort(names);
  return names;
}

/// What was opened under this name began otherwise.
tl::unexpected<ShelfFault> name_taken(const std::string& name, const std::string& from) {
  return shelf_fault({ErrorCode::conflict, fmt::format("'{}' exists already: it began as {}", name, from), "",
                      "take another name, or open that one"});
}

}  // namespace

Expected<std::string> text_named(std::string_view text, const std::string& was, const std::string& name,
                                 const fs::path& file) {
  auto editor = authoring::Editor::read(text, file);
  if (!editor) return tl::unexpected(editor.error());
  if (was != name)
    if (auto set = editor->set("id", std::vector<std::string>{name}); !set) return tl::unexpected(set.error());
  return editor->text();
}

Shelf::Shelf(fs::path scenarios, fs::path state)
    : scenarios_(std::move(scenarios)), state_(std::move(state)), records_(state_ / "catalogue.json") {}

fs::path Shelf::exhibit_file(const std::string& name) const {
  return scenarios_ / name / (name + ".x3d");
}

DraftFiles Shelf::files_of(const std::string& name) const {
  return {state_ / name, exhibit_file(name).parent_path()};
}

Expected<std::vector<std::string>> Shelf::copy_files(const std::string& name, const std::string& text,
                                                     const fs::path& from, const fs::path& to) const {
  x3d::Problems problems(name);
  const auto document = x3d::read_document(text, exhibit_file(name), problems);
  if (!document) return tl::unexpected(document.error());
  return copy_used(*document, from / kFilesFolder, to);
}

std::vector<std::string> Shelf::exhibit_names() const {
  return folders_in(scenarios_, [](const fs::path& folder, const std::string& name) {
    std::error_code unknown;
    return fs::is_regular_file(folder / (name + ".x3d"), unknown);
  });
}

std::vector<std::string> Shelf::draft_names() const {
  return folders_in(state_, [](const fs::path& folder, const std::string&) {
    std::error_code unknown;
    return fs::is_regular_file(folder / "draft.x3d", unknown);
  });
}

ShelfResult<std::string> Shelf::list() {
  const std::vector<std::string> drafts = draft_names();
  std::set<std::string> names(drafts.begin(), drafts.end());
  for (const std::string& name : exhibit_names())
    names.insert(name);
  ShelfJson exhibits = ShelfJson::array(), begins = ShelfJson::array();
  for (const std::string& name : names) {
    const bool drafted = std::ranges::binary_search(drafts, name);
    ShelfJson entry{{"name", name}, {"draft", nullptr}, {"title", ShelfJson::object()}, {"picture", nullptr}};
    if (const auto picture = picture_bytes(name)) entry["picture"] = content::content_hash(*picture);
    auto opened = drafted ? open(name) : shelf_fault({});
    // A draft that cannot be read is in the list all the same: opening it tells why.
    if (drafted && !opened) entry["draft"] = {{"revision", -1}, {"by", ""}, {"changed_s", 0}, {"problems", 1}};
    if (opened) {
      const Author& changed = (*opened)->draft.changed();
      entry["draft"] = {{"revision", (*opened)->draft.revision()},
                        {"by", changed.name},
                        {"changed_s", changed.time_s},
                        {"problems", count_errors(problems_of(name, **opened))}};
    }
    entry["title"] = title_json(facts_of(name, drafted).title);
    exhibits.push_back(std::move(entry));
  }
  for (const Template& one : templates())
    begins.push_back({{"name", one.name}, {"title", {{"el", one.title_el}, {"en", one.title_en}}}});
  return shelf_text({{"exhibits", std::move(exhibits)}, {"templates", std::move(begins)}});
}

Expected<std::string> Shelf::first_text(const std::string& name, const std::string& from) {
  constexpr std::string_view kTemplate = "template:";
  if (from.starts_with(kTemplate)) {
    const Template* known = find_template(from.substr(kTemplate.size()));
    if (known != nullptr) return text_of(*known, name);
    return fail(ErrorCode::not_found, "there is no such template", from, "take one of the list");
  }
  const std::string exhibit = from.starts_with(kFromExhibit) ? from.substr(kFromExhibit.size()) : "";
  if (!is_exhibit_name(exhibit))
    return fail(ErrorCode::invalid_value, "the request does not say what to start the draft from", from,
                "write exhibit:NAME or template:NAME");
  const auto bytes = read_whole(exhibit_file(exhibit), Draft::kMostBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found)
    return fail(ErrorCode::not_found, "there is no such exhibit", exhibit, "take one of the list");
  if (!bytes) return tl::unexpected(bytes.error());
  return text_named(as_text(*bytes), exhibit, name, exhibit_file(name));
}

ShelfResult<void> Shelf::need_place(const std::string& name, bool of_exhibit) {
  const std::vector<std::string> drafts = draft_names();
  const std::vector<std::string> exhibits = exhibit_names();
  if (std::ranges::binary_search(drafts, name)) {
    const auto opened = open(name);
    return opened ? name_taken(name, (*opened)->draft.from()) : tl::unexpected(opened.error());
  }
  if (!of_exhibit && std::ranges::binary_search(exhibits, name)) return name_taken(name, "an exhibit");
  if (drafts.size() < kMostDrafts) return {};
  return shelf_fault({ErrorCode::too_large, "there are too many drafts", "", "discard some first"});
}

ShelfResult<std::string> Shelf::begin(const std::string& name, const std::string& from, const Author& author) {
  if (!is_exhibit_name(name)) return bad_exhibit_name();
  const bool own = from == "exhibit:" + name;
  if (std::ranges::binary_search(draft_names(), name)) {
    auto opened = open(name);
    if (!opened) return tl::unexpected(opened.error());
    if (own || (*opened)->draft.from() == from) return view_of(name, **opened);
  }
  if (auto place = need_place(name, own); !place) return tl::unexpected(place.error());
  auto text = first_text(name, from);
  if (!text) return shelf_fault(text.error());
  // The text names its files beside it: a copy brings those of the exhibit that it was copied from.
  if (!own && from.starts_with(kFromExhibit)) {
    const std::string other = from.substr(kFromExhibit.size());
    const auto copied = copy_files(name, *text, exhibit_file(other).parent_path(), state_ / name / kFilesFolder);
    if (!copied) return shelf_fault(copied.error());
    std::map<std::string, std::string> names;
    for (const std::string& file : *copied)
      names[file] = fmt::format("{}/{}/{}", other, kFilesFolder, file);
    copy_records(name, names);
  }
  auto made = Draft::make(state_ / name, std::move(*text), from, author);
  if (!made) return shelf_fault(made.error());
  return view_of(name, keep(name, std::move(*made)));
}

Shelf::Open& Shelf::keep(const std::string& name, Draft draft) {
  if (open_.size() >= kMostOpen)
    open_.erase(std::ranges::min_element(open_, {}, [](const auto& entry) { return entry.second.used; }));
  const auto put = open_.insert_or_assign(name, Open{std::move(draft)}).first;
  put->second.used = ++uses_;
  return put->second;
}

ShelfResult<Shelf::Open*> Shelf::open(const std::string& name) {
  if (!is_exhibit_name(name)) return bad_exhibit_name();
  if (const auto known = open_.find(name); known != open_.end()) {
    known->second.used = ++uses_;
    return &known->second;
  }
  auto draft = Draft::open(state_ / name);
  if (!draft && draft.error().code == ErrorCode::not_found)
    return shelf_fault(
        {ErrorCode::not_found, "there is no draft of this name", name, "begin it from an exhibit or a template"});
  if (!draft) return shelf_fault(draft.error());
  return &keep(name, std::move(*draft));
}

ShelfResult<Shelf::Open*> Shelf::open_at(const std::string& name, std::int64_t revision) {
  auto opened = open(name);
  if (!opened || (*opened)->draft.revision() == revision) return opened;
  const Draft& draft = (*opened)->draft;
  return tl::unexpected(
      ShelfFault{{ErrorCode::conflict, fmt::format("the draft was changed meanwhile by {}", draft.changed().name), "",
                  "look at the draft as it is now, and make the change again"},
                 true,
                 draft.revision()});
}

const std::vector<x3d::Problem>& Shelf::problems_of(const std::string& name, Open& open) {
  if (open.checked != open.draft.revision()) {
    scenario::FileFinder finder;
    DraftLoader loader(exhibit_file(name), open.draft.file(), finder);
    open.problems = scenario::check_text(open.draft.text(), exhibit_file(name), loader);
    open.checked = open.draft.revision();
  }
  return open.problems;
}

ShelfResult<std::string> Shelf::view_of(const std::string& name, Open& open, std::vector<std::string> added) {
  const auto text = document_of(name, true);
  if (!text) return tl::unexpected(text.error());
  return view_json({name, open.draft.history(), *text, open.draft.changed().name, open.draft.notice(),
                    problems_of(name, open), std::move(added)});
}

ShelfResult<std::string> Shelf::view(const std::string& name) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  (*opened)->checked = -1;  // a mesh file may have come or gone meanwhile
  return view_of(name, **opened);
}

ShelfResult<std::string> Shelf::text(const std::string& name) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  return (*opened)->draft.text();
}

ShelfResult<std::string> Shelf::change(const std::string& name, const CommandList& list, const Author& author) {
  auto opened = open_at(name, list.revision);
  if (!opened) return tl::unexpected(opened.error());
  auto applied = apply_commands((*opened)->draft.text(), exhibit_file(name), list.commands);
  if (!applied) {
    ShelfFault fault{applied.error().error};
    fault.command = applied.error().command;
    return tl::unexpected(std::move(fault));
  }
  if (auto done = (*opened)->draft.step(studio::title_of(list.commands), applied->text, author); !done)
    return shelf_fault(done.error());
  return view_of(name, **opened, std::move(applied->added));
}

ShelfResult<std::string> Shelf::undo(const std::string& name, std::int64_t revision, const Author& author) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  if (auto done = (*opened)->draft.undo(author); !done) return shelf_fault(done.error());
  return view_of(name, **opened);
}

ShelfResult<std::string> Shelf::redo(const std::string& name, std::int64_t revision, const Author& author) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  if (auto done = (*opened)->draft.redo(author); !done) return shelf_fault(done.error());
  return view_of(name, **opened);
}

ShelfResult<std::string> Shelf::versions(const std::string& name) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  ShelfJson list = ShelfJson::array();
  for (const Version& version : Versions((*opened)->draft.folder() / "versions").all())
    list.push_back(
        {{"number", version.number}, {"title", version.title}, {"by", version.by}, {"made_s", version.made_s}});
  return shelf_text({{"versions", std::move(list)}});
}

ShelfResult<std::string> Shelf::add_version(const std::string& name, const std::string& title, const Author& author) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  const Draft& draft = (*opened)->draft;
  const auto added = Versions(draft.folder() / "versions").add(title, draft.text(), author);
  if (!added) return shelf_fault(added.error());
  return shelf_text({{"number", added->number}, {"title", added->title}, {"by", added->by}, {"made_s", added->made_s}});
}

ShelfResult<std::string> Shelf::restore(const std::string& name, std::int64_t version, std::int64_t revision,
                                        const Author& author) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  Draft& draft = (*opened)->draft;
  const auto text = Versions(draft.folder() / "versions").text(version);
  if (!text) return shelf_fault(text.error());
  if (auto done = draft.step(fmt::format("restore version {}", version), *text, author); !done)
    return shelf_fault(done.error());
  return view_of(name, **opened);
}

ShelfResult<void> Shelf::check_whole(const std::string& name, const Draft& draft) const {
  scenario::MeshFinder finder;
  DraftLoader loader(exhibit_file(name), draft.file(), finder);
  auto problems = scenario::check_text(draft.text(), exhibit_file(name), loader);
  const std::size_t errors = count_errors(problems);
  if (errors == 0) return {};
  ShelfFault fault{{ErrorCode::invalid_value, fmt::format("the draft has {} error{}", errors, errors == 1 ? "" : "s"),
                    "", "mend what the list of problems says"}};
  fault.problems = std::move(problems);
  return tl::unexpected(std::move(fault));
}

ShelfResult<PreviewDraft> Shelf::lay_out(const std::string& name, std::int64_t revision, const std::string& step) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  if (auto checked = check_whole(name, (*opened)->draft); !checked) return tl::unexpected(checked.error());
  auto compiled = compile(name);
  if (!compiled) return tl::unexpected(compiled.error());
  Expected<std::string> text = (*opened)->draft.text();
  if (!step.empty()) text = begin_at(*text, exhibit_file(name), compiled->world, step);
  if (!text) return shelf_fault(text.error());
  const fs::path folder = exhibit_file(name).parent_path();
  const auto copied = copy_files(name, *text, state_ / name, folder / kPreviewFiles);
  if (!copied) return shelf_fault(copied.error());
  auto file = write_preview(folder, with_preview_files(std::move(*text), *copied));
  if (!file) return shelf_fault(file.error());
  return PreviewDraft{std::make_shared<const state::WorldDescription>(std::move(compiled->world)), std::move(*file),
                      revision, step};
}

ShelfResult<std::string> Shelf::publish(const std::string& name, std::int64_t revision, const Author& author) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  const Draft& draft = (*opened)->draft;
  const fs::path file = exhibit_file(name);
  if (auto checked = check_whole(name, draft); !checked) return tl::unexpected(checked.error());
  const auto former = read_whole(file, Draft::kMostBytes);
  if (!former && former.error().code != ErrorCode::not_found) return shelf_fault(former.error());
  const std::string_view before = former ? as_text(*former) : std::string_view();
  const fs::path to = file.parent_path() / kFilesFolder;
  if (auto copied = copy_files(name, draft.text(), draft.folder(), to); !copied) return shelf_fault(copied.error());
  if (former && before == draft.text()) return copy_picture(draft.folder(), file.parent_path()), published();
  if (former) {
    const auto kept = Versions(draft.folder() / "versions").add("before publishing", before, author);
    if (!kept) return shelf_fault(kept.error());
  }
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return shelf_fault(file_error("cannot be made", file.parent_path(), error.value()));
  if (auto written = authoring::write_file(file, draft.text()); !written) return shelf_fault(written.error());
  copy_picture(draft.folder(), file.parent_path());
  return published();
}

ShelfResult<std::string> Shelf::discard(const std::string& name, std::int64_t revision) {
  auto opened = open_at(name, revision);
  if (!opened) return tl::unexpected(opened.error());
  const fs::path folder = state_ / kDiscarded;
  std::error_code error;
  fs::create_directories(folder, error);
  fs::path to = folder / name;
  for (int number = 2; !error && fs::exists(to); ++number)
    to = folder / fmt::format("{}-{}", name, number);
  if (!error) fs::rename(state_ / name, to, error);
  if (error) return shelf_fault(file_error("the draft cannot be moved away", state_ / name, error.value()));
  open_.erase(name);
  return shelf_text({{"discarded", true}});
}

ShelfResult<CompiledDraft> Shelf::compile(const std::string& name) {
  auto opened = open(name);
  if (!opened) return tl::unexpected(opened.error());
  const Draft& draft = (*opened)->draft;
  const fs::path file = exhibit_file(name);
  scenario::FileFinder finder;
  DraftLoader loader(file, draft.file(), finder);
  x3d::Problems problems(file.string());
  const auto document = x3d::read_document(draft.text(), file, problems);
  auto world = document ? scenario::compile(*document, loader, problems) : tl::unexpected(document.error());
  if (world) return CompiledDraft{std::move(*world), file.parent_path(), draft.file(), file.filename().string()};
  ShelfFault fault{{ErrorCode::invalid_value, "the draft cannot be shown: " + world.error().what, world.error().where,
                    world.error().remedy}};
  fault.problems = problems.all();
  return tl::unexpected(std::move(fault));
}

}  // namespace mechane::studio
