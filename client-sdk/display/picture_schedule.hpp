// When to take a picture of a visit: once a step, half a second after it began, so that something is seen of it, and once when an
// activity is done; later where a model is still on its way. Pure: time and status in, names out.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "server/base/clock.hpp"
#include <mechane/client/types.hpp>

namespace mechane::display {

class PictureSchedule {
 public:
  static constexpr Duration kSettle = std::chrono::milliseconds(500);
  static constexpr Duration kSettleDone = std::chrono::milliseconds(150);
  static constexpr Duration kPatience = std::chrono::seconds(20);  ///< with models that are on their way

  /// The name of a picture that is due now ("use-turn", "use-done"), each once in a lifetime. Call it in every turn of the loop.
  /// `whole`: nothing of the scene is on its way here; without, a picture waits, for kPatience at most.
  [[nodiscard]] std::optional<std::string> due(TimePoint now, const client::WorldStatus& status, bool whole = true);
  /// Steps that ended before their picture was due.
  [[nodiscard]] const std::set<std::string>& missed() const { return missed_; }

 private:
  std::string present_;
  TimePoint since_;
  std::map<std::string, std::string> owner_;  ///< of each name: the scenario that had it first
  std::set<std::string> taken_;
  std::set<std::string> missed_;
};

/// Fit for a file's name: what is not a letter, a digit, - or _ becomes -.
[[nodiscard]] std::string file_name(const std::string& text);

}  // namespace mechane::display
