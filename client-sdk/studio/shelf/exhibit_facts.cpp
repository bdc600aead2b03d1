#include "client-sdk/studio/shelf/exhibit_facts.hpp"

#include <fmt/format.h>

#include "server/content/catalogue.hpp"
#include "server/scenario/file_references.hpp"
#include "server/scenario/head_facts.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/values.hpp"

namespace mechane::studio {
namespace {

/// What it says in mechane:scenario.
void read_scenario(const x3d::Document& document, ExhibitFacts& facts) {
  x3d::Problems ignored("");
  for (const x3d::NodeId info : document.elements("WorldInfo")) {
    const auto set = x3d::read_metadata(document, info, "mechane:scenario", ignored);
    if (const x3d::Metadata* languages = set ? set->find("languages") : nullptr; languages != nullptr)
      facts.about.languages = languages->strings;
    const x3d::Metadata* text = set ? set->find("text") : nullptr;
    for (const x3d::Metadata& one : text == nullptr ? std::vector<x3d::Metadata>() : text->children)
      if (one.name.starts_with("title.") && one.strings.size() == 1)
        facts.title[one.name.substr(6)] = one.strings.front();
  }
}

/// Exhibits to which a step leads visitors.
void read_opened(const x3d::Document& document, ExhibitFacts& facts) {
  for (std::size_t i = 0; i < document.size(); ++i) {
    const x3d::NodeId id(i);
    if (document[id].name != "MetadataString" || x3d::name_of(document, id) != "opens") continue;
    const std::string* value = document[id].attribute("value");
    const auto ids = x3d::parse_strings(value == nullptr ? "" : *value);
    for (const std::string& exhibit : ids ? *ids : std::vector<std::string>()) {
      const x3d::NodeId step = document[id].parent;
      facts.uses.push_back(
          {fmt::format("{0}/{0}.x3d", exhibit), "step " + x3d::name_of(document, step), document[id].line, ""});
    }
  }
}

}  // namespace

std::string museum_path(const std::string& exhibit, std::string_view url) {
  const std::string path(url.substr(0, url.find('#')));
  if (path.empty() || !x3d::is_relative_path(path) || path.find(':') != std::string::npos) return {};
  std::string inside = (std::filesystem::path(exhibit) / path).lexically_normal().generic_string();
  return content::is_inside(inside) ? inside : std::string();
}

ExhibitFacts exhibit_facts(const x3d::Document& document, const std::string& name) {
  ExhibitFacts facts;
  scenario::HeadFacts head = scenario::head_facts(document);
  facts.about.description = std::move(head.description);
  facts.about.credits = std::move(head.credits);
  facts.about.tags = std::move(head.tags);
  read_scenario(document, facts);
  for (const std::string& def : document.defs(""))
    facts.names += def + " ";
  for (const scenario::FileReference& reference : scenario::file_references(document)) {
    const x3d::Node& node = document[reference.node];
    const bool sound = node.name == "MetadataString";
    // "audio.el" in the set "text" of a step.
    const std::string called = sound ? x3d::name_of(document, reference.node) : "";
    const x3d::NodeId step = sound ? document[node.parent].parent : x3d::NodeId();
    const std::string place = step ? called + " of " + x3d::name_of(document, step) : document.describe(reference.node);
    for (const std::string& url : reference.urls)
      if (std::string path = museum_path(name, url); !path.empty())
        facts.uses.push_back({std::move(path), place, node.line, sound ? called.substr(called.find('.') + 1) : ""});
  }
  read_opened(document, facts);
  return facts;
}

}  // namespace mechane::studio
