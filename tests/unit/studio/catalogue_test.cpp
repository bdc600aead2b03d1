// What a search finds, and what is read of what people have written.
#include "client-sdk/studio/shelf/catalogue.hpp"

#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client-sdk/studio/shelf/fold.hpp"
#include "server/base/random.hpp"
#include "tests/unit/studio/studio_fixture.hpp"

namespace mechane::studio {
namespace {

using nlohmann::json;

TEST(Fold, AccentsAndCapitalsAreNothingToASearch) {
  EXPECT_EQ(folded("Ἀρχιμήδης ΚΟΧΛΊΑΣ ΰ Ϋ"), "αρχιμηδησ κοχλιασ υ υ");
  EXPECT_EQ(folded("Müller Garçon"), "muller garcon");
  EXPECT_EQ(folded("ο\u0301 e\u0301"), "ο e");
  EXPECT_EQ(folded("日本 \xff\xc3 🙂"), "日本 ?? 🙂");
  Random random(7);
  for (int i = 0; i < 500; ++i) {
    std::string text;
    for (int n = 0; n < 40; ++n)
      text += static_cast<char>(random.next() & 0xFFU);
    EXPECT_EQ(folded(folded(text)), folded(text));
  }
}

/// A museum of many things, with all that a query asks for in all mixtures.
std::vector<CatalogueItem> mixed_items() {
  std::vector<CatalogueItem> items;
  const std::vector<std::string> licences{"", "CC0-1.0", "CC-BY-4.0"};
  const std::vector<std::vector<std::string>> tags{{}, {"Ξύλο"}, {"bronze", "ΞΎΛΟ"}},
      languages{{}, {"el"}, {"el", "en"}};
  for (const ItemKind kind : {ItemKind::exhibit, ItemKind::a_template, ItemKind::part, ItemKind::mesh, ItemKind::sound})
    for (std::size_t i = 0; i < 27; ++i) {
      CatalogueItem& item = items.emplace_back();
      item.kind = kind;
      item.name = "thing-" + std::to_string(items.size());
      item.title = {{"el", i % 2 == 0 ? "Ο τροχός" : "Ο μοχλός"}, {"en", i % 2 == 0 ? "The wheel" : "The lever"}};
      item.published = i % 3 != 0;
      item.draft = i % 3 != 1;
      item.about = {"", {licences[i % 3], "", "Ελένη", ""}, tags[i / 3 % 3], languages[i / 9]};
    }
  return items;
}

std::set<std::string> found(const std::vector<CatalogueItem>& items, const CatalogueQuery& query) {
  const json answer = json::parse(catalogue_json(items, query, nullptr));
  EXPECT_EQ(answer["all"], items.size());
  EXPECT_EQ(answer["tags"].size(), 3U) << "what can be chosen is all, whatever was found";
  std::set<std::string> names;
  for (const json& item : answer["items"])
    names.insert(item["name"]);
  return names;
}

TEST(Catalogue, EachFilterLeavesWhatAllOfThemLeave) {
  const auto items = mixed_items();
  const auto found_by = [&](std::string CatalogueQuery::*filter, const std::vector<std::string>& values) {
    std::map<std::string, std::set<std::string>> by;
    for (const std::string& value : values) {
      CatalogueQuery query;
      query.*filter = value;
      by[value] = found(items, query);
    }
    return by;
  };
  const auto texts = found_by(&CatalogueQuery::text, {"", "τροχος", "ΛΕΝΗ μοχλ", "wheel thing", "no such thing"});
  const auto kinds = found_by(&CatalogueQuery::kind, {"", "exhibit", "draft", "mesh", "sound", "part", "template"});
  const auto tags = found_by(&CatalogueQuery::tag, {"", "ξυλο", "Bronze"});
  const auto licences = found_by(&CatalogueQuery::licence, {"", "-", "CC0-1.0"});
  const auto languages = found_by(&CatalogueQuery::language, {"", "el", "en"});
  for (const auto& [text, with_text] : texts)
    for (const auto& [kind, of_kind] : kinds)
      for (const auto& [tag, tagged] : tags)
        for (const auto& [licence, licensed] : licences)
          for (const auto& [language, spoken] : languages) {
            std::set<std::string> all = with_text;
            for (const auto* some : {&of_kind, &tagged, &licensed, &spoken})
              std::erase_if(all, [&](const std::string& name) { return !some->contains(name); });
            ASSERT_EQ(found(items, {text, kind, tag, licence, language}), all);
          }
  EXPECT_TRUE(found(items, {.text = "no such thing"}).empty());
  EXPECT_EQ(found(items, {.tag = "ξυλο"}).size(), items.size() * 2 / 3);
  EXPECT_EQ(found(items, {.text = "ΤΡΟΧΌΣ", .kind = "mesh"}).size(), 14U);
  EXPECT_THAT(check_query({.kind = "film"}).error(), is_fault(ErrorCode::invalid_value, {"film"}));
}

TEST(Records, WhatIsHostileIsRefusedWithItsPlace) {
  const std::string long_text(2'001, 'a');
  for (const auto& [request, place] : std::vector<std::pair<std::string, std::string>>{
           {R"([])", ""},
           {R"({"path": "../a.glb", "about": {}})", "path"},
           {R"({"path": "/etc/passwd", "about": {}})", "path"},
           {R"({"about": {}})", "path"},
           {R"({"path": "a.glb"})", "about"},
           {R"({"path": "a.glb", "about": {"tags": "wood"}})", "about/tags"},
           {R"({"path": "a.glb", "about": {"tags": ["wood", 7]}})", "about/tags/1"},
           {R"({"path": "a.glb", "about": {"languages": ["../"]}})", "about/languages"},
           {R"({"path": "a.glb", "about": {"licence": "a\u0007"}})", "about/licence"},
           {R"({"path": "a.glb", "about": {"description": ")" + long_text + "\"}}", "about/description"},
           {R"({"path": "a.glb", "about": {}, "before": 1})", "before"},
           {std::string(10'000, '['), ""}}) {
    const auto about = parse_about(request);
    ASSERT_FALSE(about) << request;
    EXPECT_THAT(about.error(), is_fault(ErrorCode::invalid_value, {}));
    EXPECT_EQ(about.error().where, place) << request;
  }
  for (const char* text : {"", "{}", "[]", R"({"files": []})", R"({"files": {"../a": {}}})",
                           R"({"files": {"a.glb": 1}})", R"({"files": {"a.glb": {"tags": {}}}})"})
    EXPECT_EQ(parse_records(text).error().code, ErrorCode::damaged) << text;
}

}  // namespace
}  // namespace mechane::studio
