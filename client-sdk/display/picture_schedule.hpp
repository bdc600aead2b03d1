// When to take a picture of a visit: once per step, half a second after its beginning, and once when an activity is
// done; later if a model is still being loaded. Pure: time and status in, names out.
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
  static constexpr Duration kPatience = std::chrono::seconds(20);  ///< how long to wait for models

  /// The name of a picture that is due now ("use-turn", "use-done"); each name only once. Call it in every turn of the
  /// loop. `whole`: no part of the scene is still being loaded; otherwise a picture waits, for kPatience at most.
  [[nodiscard]] std::optional<std::string> due(TimePoint now, const client::WorldStatus& status, bool whole = true);
  /// Steps that ended before their picture was due.
  [[nodiscard]] const std::set<std::string>& missed() const { return missed_; }

 private:
  std::string present_;
  TimePoint since_;
  std::map<std::string, std::string> owner_;  ///< for each name, the scenario that had it first
  std::set<std::string> taken_;
  std::set<std::string> missed_;
};

/// Makes a text fit for a file's name: replaces all but letters, digits, - and _ by -.
[[nodiscard]] std::string file_name(const std::string& text);

}  // namespace mechane::display
