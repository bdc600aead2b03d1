#include "client-sdk/studio/shelf/catalogue.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "client-sdk/studio/shelf/fold.hpp"
#include "client-sdk/studio/shelf/shelf_text.hpp"

namespace mechane::studio {
namespace {

/// In the order of ItemKind.
constexpr std::array<std::string_view, 5> kItemKinds{"exhibit", "template", "part", "mesh", "sound"};
constexpr std::string_view kDraftKind = "draft", kNoLicence = "-";
constexpr std::size_t kLongestQuery = 500;

bool is_of_kind(const CatalogueItem& item, std::string_view kind) {
  if (kind == kDraftKind) return item.kind == ItemKind::exhibit && item.draft;
  if (kind == word_of(ItemKind::exhibit)) return item.kind == ItemKind::exhibit && item.published;
  return kind == word_of(item.kind);
}

/// All that is searched, folded.
std::string words_in(const CatalogueItem& item) {
  std::string all = item.name + "\n" + item.path + "\n" + item.words;
  for (const auto& [language, title] : item.title)
    all += "\n" + title;
  const content::Credits& credits = item.about.credits;
  for (const std::string* text : {&item.about.description, &credits.licence, &credits.author, &credits.source})
    all += "\n" + *text;
  for (const std::string& tag : item.about.tags)
    all += "\n" + tag;
  for (const FileUse& use : item.uses)
    all += "\n" + use.place;
  return folded(all);
}

ShelfJson json_of(const CatalogueItem& item) {
  ShelfJson title = ShelfJson::object();
  for (const auto& [language, text] : item.title)
    title[language] = text;
  return {{"kind", word_of(item.kind)},  {"name", item.name},   {"path", item.path},
          {"exhibit", item.exhibit},     {"title", title},      {"bytes", item.bytes},
          {"published", item.published}, {"draft", item.draft}, {"about", json_of(item.about)},
          {"uses", json_of(item.uses)}};
}

}  // namespace

std::string_view word_of(ItemKind kind) {
  return kItemKinds.at(static_cast<std::size_t>(kind));
}

Expected<void> check_query(const CatalogueQuery& query) {
  const bool known =
      query.kind.empty() || query.kind == kDraftKind || std::ranges::find(kItemKinds, query.kind) != kItemKinds.end();
  if (!known)
    return fail(ErrorCode::invalid_value, "the catalogue has no such kind", query.kind,
                "take exhibit, draft, template, part, mesh or sound");
  for (const std::string* text : {&query.text, &query.tag, &query.licence, &query.language})
    if (text->size() > kLongestQuery)
      return fail(ErrorCode::invalid_value, "this is too long to be looked for", "", "take fewer words");
  return {};
}

bool fits(const CatalogueItem& item, const CatalogueQuery& query) {
  if (!query.kind.empty() && !is_of_kind(item, query.kind)) return false;
  const Record& about = item.about;
  if (!query.licence.empty() && about.credits.licence != (query.licence == kNoLicence ? "" : query.licence))
    return false;
  if (!query.language.empty() && std::ranges::find(about.languages, query.language) == about.languages.end())
    return false;
  if (!query.tag.empty() && std::ranges::find(about.tags, folded(query.tag), folded) == about.tags.end()) return false;
  if (query.text.empty()) return true;
  const std::string all = words_in(item);
  std::istringstream wanted(folded(query.text));
  for (std::string word; wanted >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}

std::string catalogue_json(std::span<const CatalogueItem> items, const CatalogueQuery& query, const Error* notice) {
  ShelfJson found = ShelfJson::array();
  std::set<std::string> tags, licences, languages;
  for (const CatalogueItem& item : items) {
    tags.insert(item.about.tags.begin(), item.about.tags.end());
    languages.insert(item.about.languages.begin(), item.about.languages.end());
    if (!item.about.credits.licence.empty()) licences.insert(item.about.credits.licence);
    if (fits(item, query)) found.push_back(json_of(item));
  }
  ShelfJson answer{{"items", std::move(found)},
                   {"all", items.size()},
                   {"tags", tags},
                   {"licences", licences},
                   {"languages", languages}};
  if (notice != nullptr) answer["notice"] = {{"error", notice->what}, {"remedy", notice->remedy}};
  return shelf_text(answer);
}

}  // namespace mechane::studio
