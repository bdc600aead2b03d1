#include "server/app/exhibit_changes.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "server/base/whole_file.hpp"
#include "server/log/log.hpp"

namespace mechane::app {
namespace {

constexpr std::uintmax_t kMostBytes = 1 << 20;

}  // namespace

ExhibitChanges changes_since(std::span<const std::string> of_settings, const ScenarioStore& scenarios) {
  ExhibitChanges changes;
  std::error_code code;
  for (const std::string& id : scenarios.ids()) {
    if (std::ranges::find(of_settings, id) == of_settings.end())
      changes.loaded[id] = std::filesystem::absolute(scenarios.file_of(id), code);
  }
  for (const std::string& id : of_settings) {
    if (scenarios.find(id) == nullptr) changes.retired.insert(id);
  }
  return changes;
}

Expected<ExhibitChanges> read_changes(const std::filesystem::path& file) {
  const auto bytes = read_whole(file, kMostBytes);
  if (!bytes && bytes.error().code == ErrorCode::not_found) return ExhibitChanges();
  if (!bytes) return tl::unexpected(bytes.error());
  const auto refused = [&] {
    return fail(ErrorCode::damaged, "this is not what the server wrote about loaded and retired exhibits",
                file.string(), "remove the file, and load or retire the exhibits again");
  };
  const auto json = nlohmann::json::parse(as_text(*bytes), nullptr, false);
  if (!json.is_object() || !json.contains("loaded") || !json.contains("retired")) return refused();
  if (!json["loaded"].is_object() || !json["retired"].is_array()) return refused();
  ExhibitChanges changes;
  for (const auto& [id, path] : json["loaded"].items()) {
    if (!path.is_string()) return refused();
    changes.loaded[id] = path.get<std::string>();
  }
  for (const auto& id : json["retired"]) {
    if (!id.is_string()) return refused();
    changes.retired.insert(id.get<std::string>());
  }
  return changes;
}

Expected<void> write_changes(const std::filesystem::path& file, const ExhibitChanges& changes) {
  nlohmann::json loaded = nlohmann::json::object();
  for (const auto& [id, path] : changes.loaded)
    loaded[id] = path.string();
  const nlohmann::json json{{"loaded", std::move(loaded)}, {"retired", changes.retired}};
  const std::string text = json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  return write_whole(file, std::as_bytes(std::span(text)), WholeFile::durable);
}

void make_again(const ExhibitChanges& changes, const Settings& settings, ScenarioStore& scenarios) {
  for (const auto& [id, file] : changes.loaded) {
    if (scenarios.find(id) != nullptr) continue;  // the settings name it now
    auto read = load_scenario(file, settings);
    if (!read || (*read)->id != id) {
      const std::string why =
          read ? fmt::format("{} has the id '{}' now", file.string(), (*read)->id) : read.error().to_string();
      log::warning(fmt::format("exhibit {} was in use before and cannot be loaded again: {}", id, why));
      continue;
    }
    scenarios.put(std::move(*read), file);
    log::info(fmt::format("exhibit {} is loaded again, as before the restart", id));
  }
  for (const std::string& id : changes.retired) {
    scenarios.retire(id);
    log::info(fmt::format("exhibit {} {}", id,
                          scenarios.find(id) == nullptr ? "stays retired, as before the restart"
                                                        : "was retired before, and is home now: it stays"));
  }
}

}  // namespace mechane::app
