// What was loaded and retired while the server ran, kept on disk, so that a restarted server has the same exhibits.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>

#include "server/app/scenario_store.hpp"

namespace mechane::app {

/// The difference between the exhibits of the settings and those in use, by id. Main thread only.
struct ExhibitChanges {
  std::map<std::string, std::filesystem::path> loaded;  ///< that the settings do not name, with their files
  std::set<std::string> retired;                        ///< that the settings name
  friend bool operator==(const ExhibitChanges&, const ExhibitChanges&) = default;
};

/// `of_settings`: the ids that the settings name.
[[nodiscard]] ExhibitChanges changes_since(std::span<const std::string> of_settings, const ScenarioStore& scenarios);

/// None where there is no file. Errors: those of read_whole(), but not_found; damaged.
[[nodiscard]] Expected<ExhibitChanges> read_changes(const std::filesystem::path& file);
/// Errors: io_failure; then the former file is still there.
[[nodiscard]] Expected<void> write_changes(const std::filesystem::path& file, const ExhibitChanges& changes);

/// Makes the changes again in a store that was loaded from the settings, and logs each. One that cannot be made is a warning: the museum
/// opens with the others. May take minutes where new parts have to be fitted.
void make_again(const ExhibitChanges& changes, const Settings& settings, ScenarioStore& scenarios);

}  // namespace mechane::app
