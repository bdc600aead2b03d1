#include "client-sdk/authoring/editor.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "client-sdk/authoring/key_scope.hpp"
#include "client-sdk/authoring/text_edits.hpp"
#include "server/base/suggestion.hpp"
#include "server/base/whole_file.hpp"
#include "server/scenario/attributes.hpp"
#include "server/x3d/metadata.hpp"

namespace mechane::authoring {
namespace {

using Holds = Scope::Holds;

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> names;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    names.emplace_back(path.substr(0, end));
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return names;
}

/// Where a path leads: the innermost set that exists, and the rest of the path.
struct Spot {
  x3d::NodeId set;
  Scope scope;
  std::vector<std::string> rest;
};

tl::unexpected<Error> unknown_name(const std::string& name, const Scope& scope, std::string_view path) {
  return fail(ErrorCode::unknown_name, fmt::format("'{}' cannot be written here", name), std::string(path),
              suggest(name, names_in(scope), "name a key within a set; write an agent's type before its parameters"));
}

/// The first set of a path: one on a node, or mechane:scenario.
Expected<Spot> find_root(const x3d::Document& document, std::string_view path) {
  std::vector<std::string> names = split_path(path);
  if (names.empty()) return fail(ErrorCode::missing, "the path is empty", "", "name a key, like activities/use/steps");
  if (names.size() > 1 && names[1].starts_with("mechane:")) {
    const x3d::NodeId owner = document.find_def(names[0]);
    if (!owner)
      return fail(ErrorCode::unknown_name, fmt::format("no element has the DEF '{}'", names[0]), std::string(path),
                  suggest(names[0], document.defs(""), "give an element that DEF"));
    const x3d::NodeId set = x3d::find_set(document, owner, names[1]);
    if (!set)
      return fail(ErrorCode::missing, fmt::format("{} has no set '{}'", document.describe(owner), names[1]),
                  Place(std::string(path), document[owner].line), "write the set into the file first");
    names.erase(names.begin(), names.begin() + 2);
    return Spot{set, scope_of_set(document, set), std::move(names)};
  }
  for (const x3d::NodeId info : document.elements("WorldInfo")) {
    if (const x3d::NodeId set = x3d::find_set(document, info, "mechane:scenario"))
      return Spot{set, scope_of_set(document, set), std::move(names)};
  }
  return fail(ErrorCode::missing, "the file has no 'mechane:scenario'", std::string(path),
              "begin with a copy of a scenario");
}

/// Goes down from the first set as far as sets exist; the last name of the path always stays in the rest.
Expected<Spot> find_spot(const x3d::Document& document, std::string_view path) {
  auto spot = find_root(document, path);
  if (!spot) return spot;
  if (spot->rest.empty())
    return fail(ErrorCode::invalid_value, "the path ends at a whole set", std::string(path), "name a key in it");
  while (spot->rest.size() > 1) {
    const x3d::NodeId child = x3d::find_child(document, spot->set, spot->rest.front());
    if (!child || document[child].name != "MetadataSet") break;
    spot->scope = scope_of_child(document, spot->scope, spot->rest.front(), child);
    spot->set = child;
    spot->rest.erase(spot->rest.begin());
  }
  const x3d::NodeId value =
      spot->rest.size() > 1 ? x3d::find_child(document, spot->set, spot->rest.front()) : x3d::NodeId::none();
  if (value)
    return fail(ErrorCode::conflict, fmt::format("'{}' is a value, not a set", spot->rest.front()),
                Place(std::string(path), document[value].line), "remove it first, then write it as a set");
  return spot;
}

/// The element of that name within a set, as written: one with USE is not resolved. None where there is no such element.
x3d::NodeId element_in(const x3d::Document& document, x3d::NodeId set, std::string_view name) {
  const x3d::NodeId named = x3d::find_child(document, set, name);
  for (const x3d::NodeId child : document.child_elements(set)) {
    if (named && document.resolve(child) == named) return child;
  }
  return x3d::NodeId::none();
}

std::vector<std::string> sets_in(const x3d::Document& document, x3d::NodeId set) {
  std::vector<std::string> names;
  for (const x3d::NodeId child : document.child_elements(set)) {
    if (document[child].name == "MetadataSet") names.push_back(x3d::name_of(document, child));
  }
  return names;
}

/// The scope of a new set of that name; an error where it may not be here.
Expected<Scope> scope_of_new(const x3d::Document& document, const Scope& scope, const std::string& name,
                             std::string_view path) {
  const Scope inner = scope_of_child(document, scope, name, x3d::NodeId::none());
  if (inner.holds == Holds::nothing) return unknown_name(name, scope, path);
  return inner;
}

std::string numbers_in_words(const std::vector<double>& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}

/// A value as metadata: the type of its element, and its text.
struct WrittenValue {
  std::string_view element;
  std::string value;
};

bool is_of(scenario::ValueKind kind, const state::Parameter& value, bool any_count) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
    return kind == scenario::ValueKind::strings || (kind == scenario::ValueKind::string && texts->size() == 1);
  if (std::holds_alternative<bool>(value)) return kind == scenario::ValueKind::boolean;
  const std::size_t count = std::get<std::vector<double>>(value).size();
  switch (kind) {
    case scenario::ValueKind::number:
      return any_count || count == 1;
    case scenario::ValueKind::numbers:
      return true;
    case scenario::ValueKind::vector:
      return count == 3;
    case scenario::ValueKind::rotation:
      return count == 4;
    default:
      return false;
  }
}

WrittenValue to_metadata(const state::Parameter& value) {
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value))
    return {"MetadataString", quote_strings(*texts)};
  if (const auto* flag = std::get_if<bool>(&value)) return {"MetadataBoolean", *flag ? "true" : "false"};
  return {"MetadataDouble", numbers_in_words(std::get<std::vector<double>>(value))};
}

Expected<void> check_value(const Scope& scope, const std::string& name, const state::Parameter& value,
                           std::string_view path) {
  const Leaf leaf = leaf_of(scope, name);
  if (!leaf.known) return unknown_name(name, scope, path);
  if (!is_of(leaf.kind, value, scope.holds == Holds::parameters))
    return fail(ErrorCode::invalid_value, "the value is of the wrong type or count", std::string(path),
                fmt::format("write a {}", scenario::kind_in_words(leaf.kind)));
  const scenario::Key* key = scope.holds == Holds::keys ? scope.table->find(name) : nullptr;
  if (key == nullptr) return {};
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const auto* texts = std::get_if<std::vector<std::string>>(&value);
  const std::string* text = texts != nullptr && key->kind == scenario::ValueKind::string ? &texts->front() : nullptr;
  if (const auto fault = scenario::range_fault(*key, numbers != nullptr ? *numbers : std::vector<double>(), text))
    return fail(ErrorCode::invalid_value, fault->what, std::string(path), fault->remedy);
  return {};
}

std::string element_text(const WrittenValue& written, const std::string& name) {
  return fmt::format("<{} containerField='value' name='{}' value='{}'/>", written.element, escape_attribute(name),
                     escape_attribute(written.value));
}

/// Nested sets, the first outermost, around a text.
std::string in_sets(const std::vector<std::string>& names, const std::string& margin, const std::string& text) {
  std::string out = margin;
  std::string deep = margin;
  for (const std::string& name : names) {
    out += fmt::format("<MetadataSet containerField='value' name='{}'>", escape_attribute(name));
    if (!deep.empty()) deep += "  ";
    out += deep;
  }
  out += text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!deep.empty()) deep.resize(deep.size() - 2);
    out += deep + "</MetadataSet>";
  }
  return out;
}

}  // namespace

Expected<Editor> Editor::open(const std::filesystem::path& file) {
  x3d::Problems problems(file.string());
  auto document = x3d::read_document(file, problems);
  if (!document) return tl::unexpected(document.error());
  return Editor(std::move(*document));
}

Expected<Editor> Editor::read(std::string_view text, const std::filesystem::path& path) {
  x3d::Problems problems(path.string());
  auto document = x3d::read_document(text, path, problems);
  if (!document) return tl::unexpected(document.error());
  return Editor(std::move(*document));
}

Expected<void> Editor::become(const std::string& text) {
  x3d::Problems problems(document_.path().string());
  auto document = x3d::read_document(text, document_.path(), problems);
  if (!document) return tl::unexpected(document.error());
  document_ = std::move(*document);
  return {};
}

Expected<void> Editor::set(std::string_view path, const state::Parameter& value) {
  auto spot = find_spot(document_, path);
  if (!spot) return tl::unexpected(spot.error());
  const std::string name = spot->rest.back();
  Scope scope = spot->scope;
  for (std::size_t i = 0; i + 1 < spot->rest.size(); ++i) {
    auto inner = scope_of_new(document_, scope, spot->rest[i], path);
    if (!inner) return tl::unexpected(inner.error());
    scope = *inner;
  }
  if (auto good = check_value(scope, name, value, path); !good) return good;
  const WrittenValue written = to_metadata(value);
  TextEdits edits;
  const x3d::NodeId there = spot->rest.size() == 1 ? x3d::find_child(document_, spot->set, name) : x3d::NodeId::none();
  const auto fits = [&](const std::string& element) {
    if (element == written.element) return true;
    if (written.element != "MetadataDouble") return false;
    return element == "MetadataFloat" ||
           (element == "MetadataInteger" && x3d::parse_integers(written.value).has_value());
  };
  if (there && fits(document_[there].name)) {
    authoring::set_attribute(document_, there, "value", written.value, edits);
  } else if (there) {
    const x3d::ElementSpan& span = document_[there].span;
    edits.replace(span.begin, span.end, element_text(written, name));
  } else {
    std::vector<std::string> sets(spot->rest.begin(), spot->rest.end() - 1);
    append_inside(document_, spot->set,
                  in_sets(sets, inner_margin_of(document_, spot->set), element_text(written, name)), edits);
  }
  return become(edits.apply(text()));
}

Expected<void> Editor::add(std::string_view path, std::string_view after) {
  auto spot = find_spot(document_, path);
  if (!spot) return tl::unexpected(spot.error());
  Scope scope = spot->scope;
  for (const std::string& name : spot->rest) {
    auto inner = scope_of_new(document_, scope, name, path);
    if (!inner) return tl::unexpected(inner.error());
    scope = *inner;
  }
  if (const x3d::NodeId there = x3d::find_child(document_, spot->set, spot->rest.front()))
    return fail(ErrorCode::duplicate, fmt::format("'{}' exists already", spot->rest.front()),
                Place(std::string(path), document_[there].line), "take another name");
  TextEdits edits;
  const std::string margin = inner_margin_of(document_, spot->set);
  const std::vector<std::string> outer(spot->rest.begin(), spot->rest.end() - 1);
  const std::string deep = margin.empty() ? "" : margin + std::string(2 * outer.size(), ' ');
  const std::string text = in_sets(outer, margin,
                                   fmt::format("<MetadataSet containerField='value' name='{}'>{}</MetadataSet>",
                                               escape_attribute(spot->rest.back()), deep));
  if (after.empty()) {
    append_inside(document_, spot->set, text, edits);
  } else {
    const x3d::NodeId sibling = x3d::find_child(document_, spot->set, after);
    if (!sibling || spot->rest.size() > 1)
      return fail(ErrorCode::unknown_name, fmt::format("'{}' does not exist, so nothing can be put after it", after),
                  std::string(path), "name a set beside the new one");
    edits.insert(document_[sibling].span.end, text);
  }
  return become(edits.apply(this->text()));
}

Expected<void> Editor::reorder(std::string_view path, std::string_view after) {
  const auto spot = find_spot(document_, path);
  if (!spot) return tl::unexpected(spot.error());
  const std::string& name = spot->rest.front();
  const x3d::NodeId moved = spot->rest.size() == 1 ? element_in(document_, spot->set, name) : x3d::NodeId::none();
  if (!moved || document_[moved].name != "MetadataSet")
    return fail(ErrorCode::unknown_name, fmt::format("there is no set '{}' to move", name), std::string(path),
                suggest(name, sets_in(document_, spot->set), "only sets are moved"));
  const x3d::NodeId sibling = after.empty() ? x3d::NodeId::none() : element_in(document_, spot->set, after);
  if (!after.empty() && (!sibling || sibling == moved))
    return fail(ErrorCode::unknown_name, fmt::format("'{}' cannot be put after '{}'", name, after),
                Place(std::string(path), document_[moved].line),
                suggest(std::string(after), sets_in(document_, spot->set), "name another set beside it"));
  const std::vector<x3d::NodeId> children = document_.child_elements(spot->set);
  const auto first =
      std::ranges::find_if(children, [&](x3d::NodeId id) { return document_[id].name == "MetadataSet"; });
  TextEdits edits;
  move_element(document_, moved, sibling, *first, edits);
  return become(edits.apply(text()));
}

Expected<void> Editor::remove(std::string_view path) {
  auto spot = find_spot(document_, path);
  if (!spot) return tl::unexpected(spot.error());
  const x3d::NodeId there =
      spot->rest.size() == 1 ? x3d::find_child(document_, spot->set, spot->rest.front()) : x3d::NodeId::none();
  if (!there) return fail(ErrorCode::unknown_name, "there is nothing to remove", std::string(path), "check the path");
  TextEdits edits;
  remove_element(document_, there, edits);
  return become(edits.apply(text()));
}

Expected<void> Editor::set_attribute(std::string_view def, std::string_view field, std::string_view value) {
  const x3d::NodeId element = document_.find_def(def);
  if (!element)
    return fail(ErrorCode::unknown_name, fmt::format("no element has the DEF '{}'", def), std::string(def),
                suggest(std::string(def), document_.defs(""), "give an element that DEF"));
  const x3d::NodeType* type = x3d::Schema::standard().find(document_[element].name);
  const x3d::Field* known = type == nullptr ? nullptr : type->field(field);
  if (known == nullptr) {
    std::vector<std::string> names;
    if (type != nullptr) {
      for (const x3d::Field& f : type->fields)
        names.emplace_back(f.name);
    }
    return fail(ErrorCode::unknown_name, fmt::format("a {} has no field '{}'", document_[element].name, field),
                Place(std::string(def), document_[element].line),
                suggest(std::string(field), names, "name an element of X3D: X3D has no such type"));
  }
  const scenario::Table* read = scenario::find_node_table(type->name);
  if (const auto fault = scenario::attribute_fault(*known, read == nullptr ? nullptr : read->find(field), value))
    return fail(ErrorCode::invalid_value, fmt::format("{}: {}", field, fault->what),
                Place(std::string(def), document_[element].line), fault->remedy);
  TextEdits edits;
  authoring::set_attribute(document_, element, field, value, edits);
  return become(edits.apply(text()));
}

std::vector<x3d::Problem> Editor::check(scenario::ObjectLoader& loader) const {
  return scenario::check_text(text(), document_.path(), loader);
}

Expected<void> Editor::save(const std::filesystem::path& file) const {
  return write_file(file, text());
}

Expected<void> write_file(const std::filesystem::path& file, std::string_view text) {
  return write_whole(file, std::as_bytes(std::span(text)), WholeFile::document);
}

}  // namespace mechane::authoring
