#include "server/scenario/head_facts.hpp"

#include <algorithm>
#include <array>

namespace mechane::scenario {
namespace {

constexpr std::array<std::string_view, 1> kDescription{"description"}, kVersion{"version"};
constexpr std::array<std::string_view, 3> kLicence{"license", "licence", "rights"};
constexpr std::array<std::string_view, 2> kAuthor{"creator", "author"}, kSource{"reference", "source"},
    kTags{"keywords", "subject"};
constexpr std::array<std::span<const std::string_view>, 6> kMeanings{kDescription, kVersion, kLicence,
                                                                     kAuthor,      kSource,  kTags};

void add_tags(std::string_view content, std::vector<std::string>& tags) {
  for (std::size_t at = 0; at < content.size();) {
    const std::size_t end = std::min(content.find(',', at), content.size());
    const std::size_t first = content.find_first_not_of(' ', at);
    if (first < end) tags.emplace_back(content.substr(first, content.find_last_not_of(' ', end - 1) - first + 1));
    at = end + 1;
  }
}

}  // namespace

std::span<const std::string_view> same_meta_names(std::string_view name) {
  for (const auto names : kMeanings)
    if (std::ranges::find(names, name) != names.end()) return names;
  return {};
}

std::vector<x3d::NodeId> meta_elements(const x3d::Document& document) {
  std::vector<x3d::NodeId> out;
  for (const x3d::NodeId head : document.child_elements(document.x3d())) {
    if (document[head].name != "head") continue;
    for (const x3d::NodeId meta : document.child_elements(head)) {
      if (document[meta].name == "meta" && document[meta].attribute("name") != nullptr) out.push_back(meta);
    }
  }
  return out;
}

HeadFacts head_facts(const x3d::Document& document) {
  HeadFacts facts;
  const auto into = [&facts](std::string_view first) -> std::string& {
    if (first == kLicence.front()) return facts.credits.licence;
    if (first == kAuthor.front()) return facts.credits.author;
    if (first == kSource.front()) return facts.credits.source;
    return first == kVersion.front() ? facts.credits.version : facts.description;
  };
  for (const x3d::NodeId meta : meta_elements(document)) {
    const std::string* content = document[meta].attribute("content");
    const auto names = same_meta_names(*document[meta].attribute("name"));
    if (names.empty() || content == nullptr || content->empty()) continue;
    if (names.front() == kTags.front()) {
      add_tags(*content, facts.tags);
      continue;
    }
    std::string& said = into(names.front());
    if (said.find(*content) == std::string::npos) said += (said.empty() ? "" : "; ") + *content;
  }
  return facts;
}

}  // namespace mechane::scenario
