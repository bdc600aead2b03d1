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

/// Immutable after load(). Any thread.
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
  /// In the order given; at least one.
  [[nodiscard]] const std::vector<std::shared_ptr<const state::WorldDescription>>& all() const { return scenarios_; }
  [[nodiscard]] const world::WorldConfig& world_config() const { return config_; }

 private:
  std::vector<std::shared_ptr<const state::WorldDescription>> scenarios_;
  world::WorldConfig config_;
};

}  // namespace mechane::app
