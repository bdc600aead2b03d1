#include "server/scenario/compiler.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "server/base/suggestion.hpp"
#include "server/content/content_hash.hpp"
#include "server/content/mesh_import.hpp"
#include "server/scenario/compilation.hpp"
#include "server/state/limits.hpp"

namespace mechane::scenario {
namespace {

bool is_language(const std::string& text) {
  return text.size() >= 2 && text.size() <= 8 && std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-';
         });
}

/// <unit> statements in the head change the meaning of every number. Mechane reads only metres, kilograms and radians.
void refuse_units(Compilation& c) {
  for (const x3d::NodeId head : c.document.child_elements(c.document.x3d())) {
    if (c.document[head].name != "head") continue;
    for (const x3d::NodeId id : c.document.child_elements(head)) {
      if (c.document[id].name != "unit") continue;
      Attributes unit(c.document, id, c.problems);
      if (unit.given("conversionFactor") && unit.number("conversionFactor") != 1) {
        unit.error(ErrorCode::not_supported, fmt::format("the unit '{}' is not SI", unit.text("name")),
                   "write metres, kilograms, seconds and radians, and remove the unit");
      }
    }
  }
}

void read_languages(Compilation& c, const Fields& fields) {
  c.world.languages = fields.strings("languages");
  if (fields.given("languages") && c.world.languages.empty()) {
    c.problems.error(ErrorCode::missing, fields.line("languages"), fields.where(), "no language is given",
                     "write \"el\" \"en\"");
  }
  if (const std::size_t count = c.world.languages.size(); count > state::kMaxLanguages) {
    c.problems.error(ErrorCode::too_large, fields.line("languages"), fields.where(),
                     fmt::format("{} languages are too many: displays take {}", count, state::kMaxLanguages),
                     fmt::format("remove {}", count - state::kMaxLanguages));
  }
  for (const std::string& language : c.world.languages) {
    if (!is_language(language)) {
      c.problems.error(ErrorCode::invalid_value, fields.line("languages"), fields.where(),
                       fmt::format("'{}' is not a language code", language),
                       "write a language code (BCP 47), like el or en");
    }
  }
}

/// A file without our metadata becomes a scene in which bodies and joints move, but there is nothing to do. A file with some of our
/// metadata was meant to be a scenario: an error.
void take_plain_file(Compilation& c) {
  const std::string remedy = "add <WorldInfo><MetadataSet containerField='metadata' name='mechane:scenario'>...";
  const int line = c.document[c.document.scene()].line;
  for (const x3d::NodeId id : c.document.elements("MetadataSet")) {
    const std::string* name = c.document[id].attribute("name");
    if (name == nullptr || !name->starts_with("mechane")) continue;
    // It is faulty or misplaced, which has been reported.
    if (*name == "mechane:scenario") return;
    c.problems.error(ErrorCode::missing, line, "WorldInfo", "there is no metadata set 'mechane:scenario'", remedy);
    return;
  }
  c.problems.warning(ErrorCode::missing, line, "WorldInfo",
                     "the file has no 'mechane:scenario': visitors can look at the scene, but have no task in it",
                     remedy);
  const std::string stem = c.document.path().stem().string();
  c.world.id = is_id(stem) ? stem : "scene";
  c.world.languages = {"en"};
}

/// ", like my-screw" for "My Screw"; empty where the text cannot be made into an id.
std::string like_it(const std::string& text) {
  std::string id;
  for (const char letter : text.substr(0, 64)) {
    const char small = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    id += small == ' ' || small == '_' ? '-' : small;
  }
  return is_id(id) ? ", like " + id : std::string();
}

}  // namespace

bool is_id(const std::string& text) {
  const auto allowed = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), allowed);
}

const x3d::Metadata* tree_set(const Compilation& c, std::string_view name) {
  if (!c.scenario) return nullptr;
  const x3d::Metadata* found = c.scenario->find(name);
  return found != nullptr && found->kind == x3d::MetadataKind::set ? found : nullptr;
}

void report_unknown(Compilation& c, const Place& at, std::string_view word, const std::string& name,
                    std::span<const std::string> known, const std::string& if_none) {
  c.problems.error(ErrorCode::unknown_name, at.line, at.text, fmt::format("no {} is called '{}'", word, name),
                   suggest(name, known, if_none));
}

BodyId find_body(Compilation& c, const std::string& name, const Place& at) {
  const BodyId body = c.world.find_body(name);
  if (!body && !report_copies(c, at, name))
    report_unknown(c, at, "body", name, names_of(c.world.bodies), "add a RigidBody of that DEF");
  return body;
}

BodyId find_body(Compilation& c, const Fields& fields) {
  if (!fields.given("body")) return BodyId::none();
  return find_body(c, fields.string("body"), {fields.where(), fields.line("body")});
}

QuantityId find_quantity(Compilation& c, const Fields& fields) {
  if (!fields.given("quantity")) return QuantityId::none();
  const std::string name = fields.string("quantity");
  const QuantityId quantity = c.world.find_quantity(name);
  if (!quantity)
    report_unknown(c, {fields.where(), fields.line("quantity")}, "quantity", name, names_of(c.world.quantities),
                   "add it to the scenario's quantities");
  return quantity;
}

std::map<std::string, state::Texts> read_texts(Compilation& c, const x3d::Metadata* set, const std::string& where,
                                               std::string_view allowed) {
  std::map<std::string, state::Texts> texts;
  const Fields fields(set, text_table(), where, c.problems);
  if (set == nullptr) return texts;
  const std::string padded = fmt::format(" {} ", allowed);
  for (const x3d::Metadata& child : set->children) {
    if (!fields.given(child.name)) continue;
    const std::size_t dot = child.name.find('.');
    const std::string what = child.name.substr(0, dot);
    const std::string language = dot == std::string::npos ? "" : child.name.substr(dot + 1);
    const auto& known = c.world.languages;
    if (padded.find(" " + what + " ") == std::string::npos || language.empty()) {
      const std::string near = nearest(what, words_of(allowed));
      c.problems.warning(ErrorCode::unknown_name, child.line, where,
                         fmt::format("the text '{}' is not shown anywhere", child.name),
                         near.empty() || near == what || language.empty()
                             ? fmt::format("name it <what>.<language>, where <what> is one of: {}", allowed)
                             : fmt::format("did you mean '{}.{}'?", near, language));
    } else if (std::find(known.begin(), known.end(), language) == known.end()) {
      // Without any, the key languages is missing or faulty, which has been reported.
      if (known.empty() || !c.foreign_languages.insert(language).second) continue;
      c.problems.warning(ErrorCode::unknown_name, child.line, where,
                         fmt::format("'{}' is not among the scenario's languages: its texts are not shown", language),
                         fmt::format("add it to the key languages, or use one of: {}", fmt::join(known, ", ")));
    } else {
      texts[what][language] = child.strings.front();
    }
  }
  return texts;
}

void compile_scenario(Compilation& c) {
  refuse_units(c);
  for (const x3d::NodeId info : c.document.elements("WorldInfo")) {
    if (!c.scenario) c.scenario = x3d::read_metadata(c.document, info, "mechane:scenario", c.problems);
  }
  if (!c.scenario) return take_plain_file(c);
  const Fields fields(&*c.scenario, scenario_table(), "mechane:scenario", c.problems);
  if (fields.given("format") && fields.number("format") != kFormatVersion) {
    c.problems.error(
        ErrorCode::wrong_version, fields.line("format"), fields.where(),
        fmt::format("version {} of the scenario format is not known", fields.number("format")),
        fmt::format("write {}, or read the file with the version of Mechane that it was made for", kFormatVersion));
  }
  c.world.id = fields.string("id");
  if (fields.given("id") && !is_id(c.world.id)) {
    c.problems.error(ErrorCode::invalid_value, fields.line("id"), fields.where(),
                     fmt::format("'{}' cannot be an id", c.world.id.substr(0, 80)),
                     fmt::format("use small letters, digits and '-', 64 at most{}", like_it(c.world.id)));
  }
  c.world.effort_scale = fields.number("effortScale");
  read_languages(c, fields);
  c.world.title = read_texts(c, fields.set("text"), "the scenario's text", "title")["title"];
}

void compile_hash(Compilation& c) {
  const std::string& source = c.document.source();
  std::string all = "mechane-scenario " + content::content_hash(std::as_bytes(std::span(source))) + "\n";
  for (const auto& [url, hash] : c.model_hashes)
    all += fmt::format("{} {}\n", url, hash);
  c.world.content_hash = content::content_hash(std::as_bytes(std::span(all)));
}

void compile_all(Compilation& c) {
  c.world.folder = c.document.path().parent_path().string();
  check_nodes(c);
  compile_scenario(c);
  compile_bodies(c);
  compile_scenery(c);
  compile_joints(c);
  compile_components(c);
  compile_events(c);
  compile_quantities(c);
  compile_viewpoints(c);
  compile_effects(c);
  compile_activities(c);
  check_presented(c);
  check_components(c);
  check_goals(c);
  compile_visits(c);
  compile_hash(c);
  if (!c.problems.has_errors()) {
    check_agents(c);
    check_machines(c);
    check_formulas(c);
  }
  if (!c.problems.has_errors() && c.scenario) lint(c);
}

Expected<std::optional<Solid>> ObjectLoader::solid(const std::filesystem::path& file, const std::string& node) {
  const auto scene = content::import_mesh(file);
  if (!scene) return tl::unexpected(scene.error());
  const auto parts = content::collision_parts(*scene, node);
  if (!parts) return tl::unexpected(parts.error());
  return solid_of(*parts);
}

Expected<std::string> hash_file(const std::filesystem::path& file) {
  return content::content_hash(file);
}

Expected<state::WorldDescription> compile(const x3d::Document& document, ObjectLoader& loader,
                                          x3d::Problems& problems) {
  Compilation c{document, loader, problems, x3d::ShapeTree(document), {}, {}, {}, {}, {}, {}, {}, {}, {}, {},
                {},       {},     {}};
  compile_all(c);
  if (problems.has_errors()) return tl::unexpected(problems.first_error());
  return std::move(c.world);
}

Expected<state::WorldDescription> read_scenario(const std::filesystem::path& file, ObjectLoader& loader,
                                                x3d::Problems& problems) {
  const auto document = x3d::read_document(file, problems);
  if (!document) return tl::unexpected(document.error());
  return compile(*document, loader, problems);
}

}  // namespace mechane::scenario
