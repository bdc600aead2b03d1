#include "client-sdk/authoring/merge.hpp"

#include <algorithm>
#include <ostream>
#include <system_error>

#include <fmt/format.h>

#include "client-sdk/authoring/editor.hpp"
#include "client-sdk/authoring/key_scope.hpp"
#include "client-sdk/authoring/paths.hpp"
#include "client-sdk/authoring/rename.hpp"
#include "server/scenario/checker.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/values.hpp"

namespace mechane::authoring {
namespace {

namespace fs = std::filesystem;

Expected<x3d::Document> read_text(const std::string& text, const fs::path& path) {
  x3d::Problems problems(path.string());
  return x3d::read_document(text, path, problems);
}

/// The absolute folder of a file, which may be named without a folder.
fs::path folder_of(const fs::path& file) {
  std::error_code code;
  const fs::path whole = fs::absolute(file, code);
  return (code ? file : whole).lexically_normal().parent_path();
}

/// The set mechane:scenario; none where the file has none.
x3d::NodeId tree_of(const x3d::Document& document) {
  for (const x3d::NodeId info : document.elements("WorldInfo")) {
    if (const x3d::NodeId set = x3d::find_set(document, info, "mechane:scenario")) return set;
  }
  return x3d::NodeId::none();
}

x3d::NodeId first_of(const x3d::Document& document, std::string_view type) {
  const std::vector<x3d::NodeId> all = document.elements(type);
  return all.empty() ? x3d::NodeId::none() : all.front();
}

x3d::NodeId head_of(const x3d::Document& document) {
  for (const x3d::NodeId id : document.child_elements(document.x3d())) {
    if (document[id].name == "head") return id;
  }
  return x3d::NodeId::none();
}

std::string_view element_text(const x3d::Document& document, x3d::NodeId id) {
  const x3d::ElementSpan& span = document[id].span;
  return std::string_view(document.source()).substr(span.begin, span.end - span.begin);
}

/// The content of an element, without the blanks at its end; may be empty.
std::string inner_text(const x3d::Document& document, x3d::NodeId id) {
  const x3d::ElementSpan& span = document[id].span;
  if (span.tag_end == span.end) return {};
  const std::string_view inner =
      std::string_view(document.source()).substr(span.tag_end, span.inner_end - span.tag_end);
  const std::size_t last = inner.find_last_not_of(" \t\r\n");
  return last == std::string_view::npos ? std::string() : std::string(inner.substr(0, last + 1));
}

std::vector<std::string> strings_of(const x3d::Document& document, x3d::NodeId set, std::string_view key) {
  const x3d::NodeId id = x3d::find_child(document, set, key);
  const std::string* value = id ? document[id].attribute("value") : nullptr;
  if (value == nullptr) return {};
  auto strings = x3d::parse_strings(*value);
  return strings ? std::move(*strings) : std::vector<std::string>();
}

std::string value_of(const x3d::Document& document, x3d::NodeId set, std::string_view key) {
  const x3d::NodeId id = x3d::find_child(document, set, key);
  const std::string* value = id ? document[id].attribute("value") : nullptr;
  return value != nullptr ? *value : std::string();
}

/// Adds one document to another. Both have their final paths, and no name in common.
class Merge {
 public:
  Merge(const x3d::Document& ours, const x3d::Document& theirs, std::vector<MergeNote>& notes)
      : ours_(ours), theirs_(theirs), notes_(notes) {}

  Expected<std::string> run() {
    merge_head();
    merge_tree();
    merge_collections();
    // What is left of their Scene, in the order written.
    const std::string left = taken_.apply(theirs_.source());
    const auto rest = read_text(left, theirs_.path());
    if (!rest) return tl::unexpected(rest.error());
    append_inside(ours_, ours_.scene(), inner_text(*rest, rest->scene()), edits_);
    return edits_.apply(ours_.source());
  }

 private:
  void merge_head() {
    const x3d::NodeId head = head_of(ours_);
    const x3d::NodeId other = head_of(theirs_);
    if (!head || !other) return;
    std::string added;
    std::string components;
    const std::string margin = inner_margin_of(ours_, head);
    for (const x3d::NodeId id : theirs_.child_elements(other)) {
      if (theirs_[id].name == "component") {
        components += merged_component(head, id, margin);
      } else if (theirs_[id].name == "meta" && is_credit(id) && !holds(head, element_text(theirs_, id))) {
        added += margin + std::string(element_text(theirs_, id));
      }
    }
    // X3D wants components first.
    if (!components.empty() && !insert_after_last(head, "component", components)) {
      const x3d::ElementSpan& span = ours_[head].span;
      if (span.tag_end == span.end) {
        added.insert(0, components);
      } else {
        edits_.insert(span.tag_end, components);
      }
    }
    if (!added.empty()) append_inside(ours_, head, added, edits_);
  }

  /// Author and licence stay with the work.
  bool is_credit(x3d::NodeId meta) const {
    const std::string* name = theirs_[meta].attribute("name");
    return name != nullptr && scenario::one_of(*name, "license creator contributor translator reference rights source");
  }

  bool holds(x3d::NodeId head, std::string_view text) const {
    const std::vector<x3d::NodeId> all = ours_.child_elements(head);
    return std::any_of(all.begin(), all.end(), [&](x3d::NodeId id) { return element_text(ours_, id) == text; });
  }

  /// Raises our component to the higher level of the two; returns the text to add where we do not have the component.
  std::string merged_component(x3d::NodeId head, x3d::NodeId theirs, const std::string& margin) {
    const std::string* name = theirs_[theirs].attribute("name");
    const std::string* level = theirs_[theirs].attribute("level");
    for (const x3d::NodeId id : ours_.child_elements(head)) {
      const std::string* our_name = ours_[id].attribute("name");
      if (ours_[id].name != "component" || name == nullptr || our_name == nullptr || *our_name != *name) continue;
      const std::string* our_level = ours_[id].attribute("level");
      if (level != nullptr && our_level != nullptr && *level > *our_level)
        set_attribute(ours_, id, "level", *level, edits_);
      return {};
    }
    return margin + std::string(element_text(theirs_, theirs));
  }

  void merge_tree() {
    const x3d::NodeId tree = tree_of(ours_);
    const x3d::NodeId other = tree_of(theirs_);
    if (!tree || !other) return;
    std::string added;
    for (const char* key : {"agents", "machines", "quantities", "activities", "visits", "effects"}) {
      const x3d::NodeId set = x3d::find_child(theirs_, other, key);
      if (!set) continue;
      if (const x3d::NodeId ours = x3d::find_child(ours_, tree, key)) {
        append_inside(ours_, ours, inner_text(theirs_, set), edits_);
      } else {
        added += inner_margin_of(ours_, tree) + std::string(element_text(theirs_, set));
      }
    }
    if (!added.empty()) append_inside(ours_, tree, added, edits_);
    merge_languages(tree, other);
    const std::string scale = value_of(ours_, tree, "effortScale");
    const std::string their_scale = value_of(theirs_, other, "effortScale");
    if (scale != their_scale)
      notes_.push_back({MergeNote::Kind::not_kept, "effortScale", theirs_.path().string(), their_scale, scale});
    remove_element(theirs_, other, taken_);
  }

  void merge_languages(x3d::NodeId tree, x3d::NodeId other) {
    std::vector<std::string> languages = strings_of(ours_, tree, "languages");
    const std::size_t before = languages.size();
    for (const std::string& language : strings_of(theirs_, other, "languages")) {
      if (std::find(languages.begin(), languages.end(), language) == languages.end()) languages.push_back(language);
    }
    const x3d::NodeId key = x3d::find_child(ours_, tree, "languages");
    if (languages.size() > before && key) set_attribute(ours_, key, "value", quote_strings(languages), edits_);
  }

  /// Moves their bodies into our first collection: a world has one gravity.
  void merge_collections() {
    const x3d::NodeId collection = first_of(ours_, "RigidBodyCollection");
    const x3d::NodeId other = first_of(theirs_, "RigidBodyCollection");
    if (!collection || !other || is_referred_to(other)) return;
    const auto gravity = [](const x3d::Document& document, x3d::NodeId id) {
      const std::string* text = document[id].attribute("gravity");
      return text != nullptr ? *text : "0 -9.8 0";
    };
    const auto numbers = [](const std::string& text) {
      const auto read = x3d::parse_numbers(text);
      return read ? *read : std::vector<double>();
    };
    const std::string our_gravity = gravity(ours_, collection), their_gravity = gravity(theirs_, other);
    if (numbers(our_gravity) != numbers(their_gravity))
      notes_.push_back({MergeNote::Kind::not_kept, "gravity", theirs_.path().string(), their_gravity, our_gravity});
    // X3D wants bodies before joints. Text before an element, such as a comment, moves with it.
    std::string bodies;
    std::string rest;
    std::size_t from = theirs_[other].span.tag_end;
    for (const x3d::NodeId child : theirs_.child_elements(other)) {
      const std::size_t end = theirs_[child].span.end;
      (theirs_[child].name == "RigidBody" ? bodies : rest) += theirs_.source().substr(from, end - from);
      from = end;
    }
    if (!insert_after_last(collection, "RigidBody", bodies)) rest.insert(0, bodies);
    if (!rest.empty()) append_inside(ours_, collection, rest, edits_);
    remove_element(theirs_, other, taken_);
  }

  /// Inserts after our last child of a type; false where we have none.
  bool insert_after_last(x3d::NodeId parent, std::string_view type, const std::string& text) {
    x3d::NodeId last;
    for (const x3d::NodeId id : ours_.child_elements(parent)) {
      if (ours_[id].name == type) last = id;
    }
    if (last) edits_.insert(ours_[last].span.end, text);
    return static_cast<bool>(last);
  }

  /// Whether a USE, a ROUTE or an EXPORT refers to an element, which must then stay where it is.
  bool is_referred_to(x3d::NodeId id) const {
    const std::string* def = theirs_[id].attribute("DEF");
    if (def == nullptr) return false;
    for (std::size_t i = 0; i < theirs_.size(); ++i) {
      for (const x3d::Attribute& attribute : theirs_[x3d::NodeId(i)].attributes) {
        if (attribute.name != "DEF" && attribute.value == *def) return true;
      }
    }
    return false;
  }

  const x3d::Document& ours_;
  const x3d::Document& theirs_;
  std::vector<MergeNote>& notes_;
  TextEdits edits_;
  TextEdits taken_;
};

void note_renames(const Renames& renames, const std::string& file, std::vector<MergeNote>& notes) {
  const auto note = [&](const char* what, const std::map<std::string, std::string>& map) {
    for (const auto& [from, to] : map)
      notes.push_back({MergeNote::Kind::renamed, what, file, from, to});
  };
  note("name", renames.things);
  note("prototype", renames.prototypes);
  note("export", renames.exports);
  note("quantity", renames.quantities);
  note("activity", renames.activities);
  note("step", renames.steps);
  note("visit", renames.visits);
  note("effect", renames.effects);
}

/// Reads a file, with its paths made relative to the folder of the result.
Expected<x3d::Document> read_rebased(const std::string& file, const fs::path& to) {
  x3d::Problems problems(file);
  auto document = x3d::read_document(fs::path(file), problems);
  if (!document) return document;
  const fs::path from = folder_of(document->path());
  TextEdits edits;
  if (from != to)
    replace_paths(
        *document, [&](const std::string& path) { return rebased_path(path, from, to); }, edits);
  return edits.empty() ? std::move(document) : read_text(edits.apply(document->source()), file);
}

/// Takes the new file's name as the id, where it can be one.
std::string with_id(const x3d::Document& document, const fs::path& out) {
  const x3d::NodeId tree = tree_of(document);
  const x3d::NodeId id = tree ? x3d::find_child(document, tree, "id") : x3d::NodeId::none();
  const std::string stem = out.stem().string();
  const bool fits =
      !stem.empty() && stem.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
  TextEdits edits;
  if (id && fits) set_attribute(document, id, "value", quote_strings({stem}), edits);
  return edits.apply(document.source());
}

}  // namespace

std::string to_string(const MergeNote& note) {
  if (note.kind == MergeNote::Kind::renamed)
    return fmt::format("the {} {} of {} is now {}", note.what, note.theirs, note.file, note.ours);
  return fmt::format("{}: '{}' of the first file is kept, '{}' of {} is not: a scenario has one {}", note.what,
                     note.ours, note.theirs, note.file, note.what);
}

Expected<std::string> merge_documents(const x3d::Document& ours, const x3d::Document& theirs,
                                      std::vector<MergeNote>& notes) {
  const Renames renames = renames_for(names_of_file(ours), names_of_file(theirs));
  const std::string file = theirs.path().string();
  note_renames(renames, file, notes);
  TextEdits edits;
  rename_in(theirs, renames, edits);
  const auto apart = read_text(edits.apply(theirs.source()), file);
  if (!apart) return tl::unexpected(apart.error());
  return Merge(ours, *apart, notes).run();
}

Expected<Merged> merge_files(std::span<const std::string> files, const fs::path& out) {
  if (files.size() < 2)
    return fail(ErrorCode::missing, "fewer than two files are given", "", "name two files or more to merge");
  Merged merged;
  const fs::path folder = folder_of(out);
  auto ours = read_rebased(files.front(), folder);
  if (!ours) return tl::unexpected(ours.error());
  for (const std::string& file : files.subspan(1)) {
    const auto theirs = read_rebased(file, folder);
    if (!theirs) return tl::unexpected(theirs.error());
    const auto both = merge_documents(*ours, *theirs, merged.notes);
    if (!both) return tl::unexpected(both.error());
    ours = read_text(*both, out);
    if (!ours) return tl::unexpected(ours.error());
  }
  merged.text = with_id(*ours, out);
  return merged;
}

int run_merge(std::span<const std::string> files, const std::string& out_file, std::ostream& out) {
  const auto merged = merge_files(files, out_file);
  if (!merged) {
    out << "mechane merge: " << merged.error().to_string() << "\n";
    return 2;
  }
  if (const auto written = write_file(out_file, merged->text); !written) {
    out << "mechane merge: " << written.error().to_string() << "\n";
    return 2;
  }
  for (const MergeNote& note : merged->notes)
    out << to_string(note) << "\n";
  const std::vector<std::string> names{out_file};
  return scenario::run_check(names, out);
}

}  // namespace mechane::authoring
