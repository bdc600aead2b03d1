#include "server/scenario/merge.hpp"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

#include "server/scenario/checker.hpp"
#include "server/scenario/editor.hpp"
#include "server/scenario/file_references.hpp"
#include "server/scenario/key_scope.hpp"
#include "server/scenario/rename.hpp"
#include "server/scenario/values.hpp"

namespace mechane::scenario {
namespace {

namespace fs = std::filesystem;

Expected<Document> read_text(const std::string& text, const fs::path& path) {
  Problems problems(path.string());
  return read_document(text, path, problems);
}

std::string rebased(const std::string& url, const fs::path& from, const fs::path& to) {
  if (!is_relative_path(url)) return url;
  // "model.glb#NODE" keeps what stands behind the '#'.
  const std::size_t hash = std::min(url.find('#'), url.size());
  const fs::path target = fs::absolute(from / url.substr(0, hash)).lexically_normal();
  return target.lexically_relative(fs::absolute(to).lexically_normal()).generic_string() + url.substr(hash);
}

/// Paths as they must stand in a file of the folder `to`.
void rebase_paths(const Document& document, const fs::path& to, TextEdits& edits) {
  const fs::path from = document.path().parent_path();
  if (fs::absolute(from).lexically_normal() == fs::absolute(to).lexically_normal()) return;
  for (FileReference& reference : file_references(document)) {
    for (std::string& one : reference.urls)
      one = rebased(one, from, to);
    set_attribute(document, reference.node, reference.attribute, quote_strings(reference.urls), edits);
  }
}

/// mechane:scenario; none where there is none.
NodeId tree_of(const Document& document) {
  for (const NodeId info : document.elements("WorldInfo")) {
    if (const NodeId set = find_set(document, info, "mechane:scenario")) return set;
  }
  return NodeId::none();
}

NodeId first_of(const Document& document, std::string_view type) {
  const std::vector<NodeId> all = document.elements(type);
  return all.empty() ? NodeId::none() : all.front();
}

NodeId head_of(const Document& document) {
  for (const NodeId id : document.child_elements(document.x3d())) {
    if (document[id].name == "head") return id;
  }
  return NodeId::none();
}

std::string_view element_text(const Document& document, NodeId id) {
  const XmlElementSpan& span = document[id].span;
  return std::string_view(document.source()).substr(span.begin, span.end - span.begin);
}

/// What an element holds, without the blanks behind the last of it; empty where it holds nothing.
std::string inner_text(const Document& document, NodeId id) {
  const XmlElementSpan& span = document[id].span;
  if (span.tag_end == span.end) return {};
  const std::string_view inner =
      std::string_view(document.source()).substr(span.tag_end, span.inner_end - span.tag_end);
  const std::size_t last = inner.find_last_not_of(" \t\r\n");
  return last == std::string_view::npos ? std::string() : std::string(inner.substr(0, last + 1));
}

std::vector<std::string> strings_of(const Document& document, NodeId set, std::string_view key) {
  const NodeId id = find_child(document, set, key);
  const std::string* value = id ? document[id].attribute("value") : nullptr;
  if (value == nullptr) return {};
  auto strings = parse_strings(*value);
  return strings ? std::move(*strings) : std::vector<std::string>();
}

std::string value_of(const Document& document, NodeId set, std::string_view key) {
  const NodeId id = find_child(document, set, key);
  const std::string* value = id ? document[id].attribute("value") : nullptr;
  return value != nullptr ? *value : std::string();
}

/// Adds one document to another. Both have their paths right and no name in common.
class Merge {
 public:
  Merge(const Document& ours, const Document& theirs, std::vector<std::string>& notes)
      : ours_(ours), theirs_(theirs), notes_(notes) {}

  Expected<std::string> run() {
    merge_head();
    merge_tree();
    merge_collections();
    // All that is left of their Scene, in the order written.
    const std::string left = taken_.apply(theirs_.source());
    const auto rest = read_text(left, theirs_.path());
    if (!rest) return tl::unexpected(rest.error());
    append_inside(ours_, ours_.scene(), inner_text(*rest, rest->scene()), edits_);
    return edits_.apply(ours_.source());
  }

 private:
  void merge_head() {
    const NodeId head = head_of(ours_);
    const NodeId other = head_of(theirs_);
    if (!head || !other) return;
    std::string added;
    std::string components;
    const std::string margin = inner_margin_of(ours_, head);
    for (const NodeId id : theirs_.child_elements(other)) {
      if (theirs_[id].name == "component") {
        components += merged_component(head, id, margin);
      } else if (theirs_[id].name == "meta" && is_credit(id) && !holds(head, element_text(theirs_, id))) {
        added += margin + std::string(element_text(theirs_, id));
      }
    }
    // X3D wants components first.
    if (!components.empty() && !insert_after_last(head, "component", components)) {
      const XmlElementSpan& span = ours_[head].span;
      if (span.tag_end == span.end) {
        added.insert(0, components);
      } else {
        edits_.insert(span.tag_end, components);
      }
    }
    if (!added.empty()) append_inside(ours_, head, added, edits_);
  }

  /// Who made it, and under which licence, stays with the work.
  bool is_credit(NodeId meta) const {
    const std::string* name = theirs_[meta].attribute("name");
    return name != nullptr && one_of(*name, "license creator contributor translator reference rights source");
  }

  bool holds(NodeId head, std::string_view text) const {
    const std::vector<NodeId> all = ours_.child_elements(head);
    return std::any_of(all.begin(), all.end(), [&](NodeId id) { return element_text(ours_, id) == text; });
  }

  /// The higher level of the two; a text to add where ours has none of it.
  std::string merged_component(NodeId head, NodeId theirs, const std::string& margin) {
    const std::string* name = theirs_[theirs].attribute("name");
    const std::string* level = theirs_[theirs].attribute("level");
    for (const NodeId id : ours_.child_elements(head)) {
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
    const NodeId tree = tree_of(ours_);
    const NodeId other = tree_of(theirs_);
    if (!tree || !other) return;
    std::string added;
    for (const char* key : {"agents", "machines", "quantities", "activities", "visits", "effects"}) {
      const NodeId set = find_child(theirs_, other, key);
      if (!set) continue;
      if (const NodeId ours = find_child(ours_, tree, key)) {
        append_inside(ours_, ours, inner_text(theirs_, set), edits_);
      } else {
        added += inner_margin_of(ours_, tree) + std::string(element_text(theirs_, set));
      }
    }
    if (!added.empty()) append_inside(ours_, tree, added, edits_);
    merge_languages(tree, other);
    const std::string scale = value_of(ours_, tree, "effortScale");
    const std::string their_scale = value_of(theirs_, other, "effortScale");
    if (scale != their_scale) {
      notes_.push_back(fmt::format("effortScale: '{}' of the first file is kept, '{}' of {} is not: a world has one",
                                   scale, their_scale, theirs_.path().string()));
    }
    remove_element(theirs_, other, taken_);
  }

  void merge_languages(NodeId tree, NodeId other) {
    std::vector<std::string> languages = strings_of(ours_, tree, "languages");
    const std::size_t before = languages.size();
    for (const std::string& language : strings_of(theirs_, other, "languages")) {
      if (std::find(languages.begin(), languages.end(), language) == languages.end()) languages.push_back(language);
    }
    const NodeId key = find_child(ours_, tree, "languages");
    if (languages.size() > before && key) set_attribute(ours_, key, "value", quote_strings(languages), edits_);
  }

  /// Their bodies move in our first collection: a world has one gravity.
  void merge_collections() {
    const NodeId collection = first_of(ours_, "RigidBodyCollection");
    const NodeId other = first_of(theirs_, "RigidBodyCollection");
    if (!collection || !other || is_referred_to(other)) return;
    const auto gravity = [](const Document& document, NodeId id) {
      const std::string* text = document[id].attribute("gravity");
      const auto numbers = parse_numbers(text != nullptr ? *text : "0 -9.8 0");
      return numbers ? *numbers : std::vector<double>();
    };
    if (gravity(ours_, collection) != gravity(theirs_, other))
      notes_.push_back(
          fmt::format("gravity: that of the first file is kept, that of {} is not", theirs_.path().string()));
    // X3D wants bodies before joints. What stands before an element, a comment say, goes with it.
    std::string bodies;
    std::string rest;
    std::size_t from = theirs_[other].span.tag_end;
    for (const NodeId child : theirs_.child_elements(other)) {
      const std::size_t end = theirs_[child].span.end;
      (theirs_[child].name == "RigidBody" ? bodies : rest) += theirs_.source().substr(from, end - from);
      from = end;
    }
    if (!insert_after_last(collection, "RigidBody", bodies)) rest.insert(0, bodies);
    if (!rest.empty()) append_inside(ours_, collection, rest, edits_);
    remove_element(theirs_, other, taken_);
  }

  /// Behind our last child of a type; false where there is none.
  bool insert_after_last(NodeId parent, std::string_view type, const std::string& text) {
    NodeId last;
    for (const NodeId id : ours_.child_elements(parent)) {
      if (ours_[id].name == type) last = id;
    }
    if (last) edits_.insert(ours_[last].span.end, text);
    return static_cast<bool>(last);
  }

  /// By a USE, a ROUTE or an EXPORT: it must stay where it is.
  bool is_referred_to(NodeId id) const {
    const std::string* def = theirs_[id].attribute("DEF");
    if (def == nullptr) return false;
    for (std::size_t i = 0; i < theirs_.size(); ++i) {
      for (const Attribute& attribute : theirs_[NodeId(i)].attributes) {
        if (attribute.name != "DEF" && attribute.value == *def) return true;
      }
    }
    return false;
  }

  const Document& ours_;
  const Document& theirs_;
  std::vector<std::string>& notes_;
  TextEdits edits_;
  TextEdits taken_;
};

void note_renames(const Renames& renames, const std::string& file, std::vector<std::string>& notes) {
  const auto note = [&](std::string_view what, const std::map<std::string, std::string>& map) {
    for (const auto& [from, to] : map)
      notes.push_back(fmt::format("{} {} of {} is now {}", what, from, file, to));
  };
  note("the name", renames.things);
  note("the prototype", renames.prototypes);
  note("the export", renames.exports);
  note("the quantity", renames.quantities);
  note("the activity", renames.activities);
  note("the step", renames.steps);
  note("the visit", renames.visits);
  note("the effect", renames.effects);
}

/// Reads a file with its paths made right for the folder where the result will lie.
Expected<Document> read_rebased(const std::string& file, const fs::path& to) {
  Problems problems(file);
  auto document = read_document(fs::path(file), problems);
  if (!document) return document;
  TextEdits edits;
  rebase_paths(*document, to, edits);
  return edits.empty() ? std::move(document) : read_text(edits.apply(document->source()), file);
}

Expected<Document> renamed(const Document& ours, const Document& theirs, const std::string& file,
                           std::vector<std::string>& notes) {
  const Renames renames = renames_for(names_of_file(ours), names_of_file(theirs));
  note_renames(renames, file, notes);
  TextEdits edits;
  rename_in(theirs, renames, edits);
  return read_text(edits.apply(theirs.source()), file);
}

/// The id is the new file's name, where that can be one.
std::string with_id(const Document& document, const fs::path& out) {
  const NodeId tree = tree_of(document);
  const NodeId id = tree ? find_child(document, tree, "id") : NodeId::none();
  const std::string stem = out.stem().string();
  const bool fits =
      !stem.empty() && stem.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos;
  TextEdits edits;
  if (id && fits) set_attribute(document, id, "value", quote_strings({stem}), edits);
  return edits.apply(document.source());
}

}  // namespace

Expected<Merged> merge_files(std::span<const std::string> files, const fs::path& out) {
  if (files.size() < 2) return fail("there is nothing to merge", "", "name two files or more");
  Merged merged;
  auto ours = read_rebased(files.front(), out.parent_path());
  if (!ours) return tl::unexpected(ours.error());
  for (const std::string& file : files.subspan(1)) {
    auto theirs = read_rebased(file, out.parent_path());
    if (!theirs) return tl::unexpected(theirs.error());
    auto apart = renamed(*ours, *theirs, file, merged.notes);
    if (!apart) return tl::unexpected(apart.error());
    const auto both = Merge(*ours, *apart, merged.notes).run();
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
  for (const std::string& note : merged->notes)
    out << note << "\n";
  const std::vector<std::string> names{out_file};
  return run_check(names, out);
}

}  // namespace mechane::scenario
