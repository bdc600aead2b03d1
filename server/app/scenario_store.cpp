#include "server/app/scenario_store.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "server/app/scenario_files.hpp"
#include "server/content/object_store.hpp"
#include "server/log/log.hpp"
#include "server/scenario/compiler.hpp"

namespace mechane::app {
namespace {

/// Gives the scenario's compiler its collision objects: built, or from the cache.
class StoreLoader final : public scenario::ObjectLoader {
 public:
  explicit StoreLoader(content::ObjectStore& store) : store_(store) {}
  [[nodiscard]] Expected<std::shared_ptr<const collision::Object>> load(const std::filesystem::path& file,
                                                                        const std::string& node,
                                                                        const geometry::SolidChoice& solid) override {
    collision_build::BuildConfig config;
    config.solid = solid;
    return store_.load(file, node, config);
  }
  [[nodiscard]] Expected<std::string> content_hash(const std::filesystem::path& file) override {
    return scenario::hash_file(file);
  }

 private:
  content::ObjectStore& store_;
};

/// A scale other than 1 makes another world, with another hash: its journals cannot be replayed with the unscaled one.
void scale_touch(state::WorldDescription& description, double scale) {
  if (scale == 1) return;
  for (state::BodyDescription& body : description.bodies) {
    body.haptic.stiffness_n_per_m *= scale;
    body.haptic.damping_ns_per_m *= scale;
  }
  description.touch_scale = scale;
  description.content_hash += fmt::format("-touch{}", scale);
}

Expected<std::shared_ptr<const state::WorldDescription>> load_one(const std::filesystem::path& file,
                                                                  StoreLoader& loader, double stiffness_scale) {
  log::info(fmt::format("reading {}", file.string()));
  x3d::Problems problems(file.string());
  auto description = scenario::read_scenario(file, loader, problems);
  for (const x3d::Problem& problem : problems.all()) {
    if (problem.severity == x3d::Severity::warning) log::warning(to_string(problem));
  }
  if (!description) return tl::unexpected(description.error());
  scale_touch(*description, stiffness_scale);
  return std::make_shared<const state::WorldDescription>(std::move(*description));
}

}  // namespace

Expected<std::shared_ptr<const state::WorldDescription>> load_scenario(const std::filesystem::path& file,
                                                                       const Settings& settings) {
  content::ObjectStore objects(settings.cache);
  StoreLoader loader(objects);
  const auto files = find_scenarios(std::span(&file, 1), settings.catalogue);  // for its warnings
  if (!files) return tl::unexpected(files.error());
  return load_one(file, loader, settings.stiffness_scale);
}

Expected<ScenarioStore> ScenarioStore::load(const Settings& settings) {
  ScenarioStore result;
  content::ObjectStore objects(settings.cache);
  StoreLoader loader(objects);
  const auto files = find_scenarios(settings.scenarios, settings.catalogue);
  if (!files) return tl::unexpected(files.error());
  for (const std::filesystem::path& file : *files) {
    auto description = load_one(file, loader, settings.stiffness_scale);
    if (!description) return tl::unexpected(description.error());
    if (result.find((*description)->id) != nullptr) {
      return fail(ErrorCode::duplicate, fmt::format("two scenarios have the id '{}'", (*description)->id),
                  file.string(), "give one of them another id");
    }
    result.put(std::move(*description), file);
  }
  auto hand = haptics::HandModel::create(settings.hand);
  if (!hand) return tl::unexpected(hand.error());
  result.config_.hand = std::make_shared<const haptics::HandModel>(std::move(*hand));
  result.config_.force = settings.force;
  return result;
}

std::shared_ptr<const state::WorldDescription> ScenarioStore::find(const std::string& id) const {
  const auto it = std::find_if(scenarios_.begin(), scenarios_.end(), [&](const auto& s) { return s->id == id; });
  return it == scenarios_.end() ? nullptr : *it;
}

std::filesystem::path ScenarioStore::file_of(const std::string& id) const {
  const auto found = files_.find(id);
  return found == files_.end() ? std::filesystem::path() : found->second;
}

std::vector<std::string> ScenarioStore::ids() const {
  std::vector<std::string> ids(scenarios_.size());
  std::ranges::transform(scenarios_, ids.begin(), [](const auto& s) { return s->id; });
  return ids;
}

void ScenarioStore::put(std::shared_ptr<const state::WorldDescription> scenario, std::filesystem::path file) {
  files_[scenario->id] = std::move(file);
  const auto it = std::ranges::find(scenarios_, scenario->id, [](const auto& s) { return s->id; });
  if (it == scenarios_.end()) {
    scenarios_.push_back(std::move(scenario));
  } else {
    *it = std::move(scenario);
  }
}

void ScenarioStore::retire(const std::string& id) {
  std::erase_if(scenarios_, [&](const auto& s) { return s->id == id && s != scenarios_.front(); });
  if (find(id) == nullptr) files_.erase(id);
}

}  // namespace mechane::app
