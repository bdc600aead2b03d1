// LiveEdit: the exhibit that an author tries goes on with the edited file, where it can.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "server/app/lobby.hpp"
#include "server/app/scenario_store.hpp"
#include "server/app/settings.hpp"
#include "server/base/worker.hpp"

namespace mechane::app {

/// Of "edit 17": 17, which the answer has, too.
[[nodiscard]] std::optional<std::uint64_t> parse_edit_order(std::string_view line);

/// Main thread only; reads the first scenario's file anew, on a thread of its own. Where that is bad, everything stays as it was.
class LiveEdit {
 public:
  /// All references outlive it. `reader`: what it still reads when this goes is dropped.
  LiveEdit(const Settings& settings, ScenarioStore& scenarios, Lobby& lobby, Worker& reader)
      : settings_(settings), scenarios_(scenarios), lobby_(lobby), reader_(reader) {}

  /// One that has not been begun yet gives way to it: its file is read by this one.
  void order(std::uint64_t number) { next_ = number; }
  /// Call it in each turn of the main thread, before Lobby::tidy(). Returns a line for whoever gave the order, when one is done: "edit 17
  /// taken"; "edit 17 body LOAD", with the word of world::Obstacle::Kind and a name; "edit 17 failed". Otherwise nothing.
  [[nodiscard]] std::string look();

 private:
  using Read = Expected<std::shared_ptr<const state::WorldDescription>>;
  [[nodiscard]] std::string finish(const Read& read);

  const Settings& settings_;
  ScenarioStore& scenarios_;
  Lobby& lobby_;
  Worker& reader_;
  std::optional<std::uint64_t> next_;
  std::uint64_t number_ = 0;  // of the one that is being read
  std::future<Read> reading_;
};

}  // namespace mechane::app
