#include "server/scenario/facts.hpp"

#include <fmt/format.h>

#include "server/scenario/compiler.hpp"
#include "server/scenario/file_finder.hpp"
#include "server/scenario/file_references.hpp"
#include "server/scenario/head_facts.hpp"
#include "server/x3d/document.hpp"
#include "server/x3d/metadata.hpp"
#include "server/x3d/values.hpp"

namespace mechane::scenario {
namespace {

using Wordings = std::map<std::string, std::vector<std::string>>;

void add_wording(Wordings& wordings, const std::string& what, const state::Texts& texts) {
  std::vector<std::string>& languages = wordings[what];
  for (const auto& [language, words] : texts) {
    if (!words.empty()) languages.push_back(language);
  }
}

void add_questions(Wordings& wordings, const state::ActivityDescription& activity) {
  for (const state::QuestionDescription& question : activity.questionnaire) {
    const std::string where = fmt::format("activity {}, question {}", activity.name, question.name);
    add_wording(wordings, where, question.question);
    for (const auto& answer : question.answers)
      add_wording(wordings, fmt::format("{}, answer {}", where, answer.name), answer.text);
    if (question.kind != state::QuestionDescription::Kind::scale) continue;
    add_wording(wordings, where + ", low", question.low);
    add_wording(wordings, where + ", high", question.high);
  }
}

/// All texts that a visitor reads or hears. A step must have a caption; other texts may be absent, but not in one language only.
Wordings wordings_of(const state::WorldDescription& world) {
  Wordings wordings;
  add_wording(wordings, "title", world.title);
  for (const state::ActivityDescription& activity : world.activities) {
    add_wording(wordings, fmt::format("activity {}, title", activity.name), activity.title);
    if (!activity.goal.empty()) add_wording(wordings, fmt::format("activity {}, goal", activity.name), activity.goal);
    add_questions(wordings, activity);
  }
  for (const state::BodyDescription& body : world.bodies)
    if (!body.title.empty()) add_wording(wordings, fmt::format("body {}, title", body.name), body.title);
  for (const state::QuantityDescription& quantity : world.quantities)
    if (!quantity.label.empty())
      add_wording(wordings, fmt::format("quantity {}, label", quantity.name), quantity.label);
  for (const state::StepDescription& step : world.steps) {
    if (!step.texts.contains("caption")) add_wording(wordings, fmt::format("step {}, caption", step.name), {});
    for (const auto& [what, texts] : step.texts)
      add_wording(wordings, fmt::format("step {}, {}", step.name, what), texts);
  }
  return wordings;
}

void read_files(const x3d::Document& document, ScenarioFacts& facts) {
  for (const FileReference& reference : file_references(document)) {
    const std::string name = x3d::name_of(document, reference.node);
    const bool sound = document[reference.node].name == "MetadataString";
    for (const std::string& url : reference.urls) {
      const std::string path = url.substr(0, url.find('#'));
      // A url may hold a script: "ecmascript:...".
      if (x3d::is_relative_path(path) && path.find(':') == std::string::npos)
        facts.files.emplace(path, sound ? name.substr(name.find('.') + 1) : "");
    }
  }
}

}  // namespace

Expected<ScenarioFacts> read_facts(const std::filesystem::path& file) {
  x3d::Problems problems(file.string());
  const Expected<x3d::Document> document = x3d::read_document(file, problems);
  if (!document) return tl::unexpected(document.error());
  FileFinder finder;
  const auto world = compile(*document, finder, problems);
  if (!world) return tl::unexpected(world.error());
  ScenarioFacts facts;
  facts.id = world->id;
  facts.titles = world->title;
  facts.languages = world->languages;
  facts.wordings = wordings_of(*world);
  for (const state::StepDescription& step : world->steps) {
    if (!step.opens.empty()) facts.opens.insert(step.opens);
  }
  HeadFacts head = head_facts(*document);
  facts.credits = std::move(head.credits);
  facts.tags = std::move(head.tags);
  read_files(*document, facts);
  return facts;
}

}  // namespace mechane::scenario
