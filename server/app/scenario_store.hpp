// The scenarios that a program was given, read once and ready to become worlds.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "server/app/settings.hpp"
#include "server/base/error.hpp"
#include "server/state/description.hpp"
#include "server/world/world.hpp"

namespace mechane::app {

/// Reads one scenario: builds its collision parts or takes them from the cache. May take minutes the first time; logs what it does. Any
/// thread but those of loops. Errors: the first problem, with file and line.
[[nodiscard]] Expected<std::shared_ptr<const state::WorldDescription>> load_scenario(const std::filesystem::path& file,
                                                                                     const Settings& settings);

/// One thread at a time.
class ScenarioStore {
 public:
  /// Reads every scenario of the settings, builds its collision parts or takes them from the cache, and makes the hand. May take minutes
  /// the first time; logs what it does. Errors: the first problem of a scenario, with file and line; duplicate (two scenarios with one
  /// id).
  [[nodiscard]] static Expected<ScenarioStore> load(const Settings& settings);

  /// Null when no scenario has this id.
  [[nodiscard]] std::shared_ptr<const state::WorldDescription> find(const std::string& id) const;
  /// The first that was given: for kiosks that ask for no other.
  [[nodiscard]] std::shared_ptr<const state::WorldDescription> first() const { return scenarios_.front(); }
  /// The file that the scenario of this id was read from; empty where there is none.
  [[nodiscard]] std::filesystem::path file_of(const std::string& id) const;
  /// Adds a scenario, or puts it in the place of the one with its id. Worlds that run the former one keep it.
  void put(std::shared_ptr<const state::WorldDescription> scenario, std::filesystem::path file);
  /// Takes a scenario away; not the first. Worlds that run it keep it.
  void retire(const std::string& id);
  /// In the order given; at least one.
  [[nodiscard]] const std::vector<std::shared_ptr<const state::WorldDescription>>& all() const { return scenarios_; }
  /// Of all, in this order.
  [[nodiscard]] std::vector<std::string> ids() const;
  [[nodiscard]] const world::WorldConfig& world_config() const { return config_; }

 private:
  std::vector<std::shared_ptr<const state::WorldDescription>> scenarios_;
  std::map<std::string, std::filesystem::path> files_;  // by id
  world::WorldConfig config_;
};

}  // namespace mechane::app
