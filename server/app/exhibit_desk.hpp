// ExhibitDesk: loads, replaces and retires exhibits while the server runs, for those who have its key.
#pragma once

#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/app/lobby.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/settings.hpp"
#include "server/base/worker.hpp"
#include "server/transport/server_transport.hpp"

namespace mechane::app {

/// The folder from which exhibits are loaded by name: that of the settings, or else the one in which the first scenario's folder lies.
[[nodiscard]] std::filesystem::path exhibits_folder(const Settings& settings, const ScenarioStore& scenarios);

/// FOLDER/NAME/NAME.x3d, or FOLDER/NAME.x3d. Errors: invalid_value (not a name), not_found; conflict, where a link leads out of the folder.
[[nodiscard]] Expected<std::filesystem::path> exhibit_file(const std::filesystem::path& folder,
                                                           const std::string& name);

/// The names in the folder that exhibit_file() finds, sorted; at most 256.
[[nodiscard]] std::vector<std::string> exhibits_in(const std::filesystem::path& folder);

/// The file that an order reads; none for one that reads none. Errors: conflict (it is loaded already, or is home), unknown_name, and those
/// of exhibit_file().
[[nodiscard]] Expected<std::filesystem::path> file_of_order(const transport::ExhibitOrder& order,
                                                            const ScenarioStore& scenarios,
                                                            const std::filesystem::path& folder);

/// Main thread only; reads scenarios on a thread of its own, one after another. Where one is bad, everything stays as it was.
class ExhibitDesk {
 public:
  static constexpr std::size_t kMostWaiting = 16;  ///< orders; further ones are refused until one is done

  /// All references outlive it. `reader`: on which scenarios are read; what it still reads when the desk goes is dropped.
  /// `of_settings`: the ids that the settings name.
  ExhibitDesk(const Settings& settings, std::vector<std::string> of_settings, ScenarioStore& scenarios,
              transport::ServerTransport& transport, Lobby& lobby, Worker& reader);

  /// Takes orders, and puts what was read into use. Call it in each turn of the main thread, before Lobby::tidy().
  void look(TimePoint now);
  /// Tells what there is, where it has changed. Some times a second.
  void publish(TimePoint now);

 private:
  using Read = Expected<std::shared_ptr<const state::WorldDescription>>;

  void begin(transport::ExhibitOrder order);
  void finish(Read read);
  [[nodiscard]] Expected<void> check(const Read& read, const std::string& wanted) const;
  void answer(const transport::ExhibitOrder& order, const Expected<void>& done);
  void note_change();

  const Settings& settings_;
  const std::vector<std::string> of_settings_;
  ScenarioStore& scenarios_;
  transport::ServerTransport& transport_;
  Lobby& lobby_;
  Worker& reader_;
  const std::filesystem::path folder_;
  std::deque<transport::ExhibitOrder> waiting_;
  std::optional<transport::ExhibitOrder> preparing_;
  std::filesystem::path file_;  // that is being read
  std::future<Read> reading_;
  std::vector<transport::ExhibitAnswer> answers_;  // the newest last
  std::vector<std::string> loadable_;
  TimePoint next_listing_{};
};

}  // namespace mechane::app
