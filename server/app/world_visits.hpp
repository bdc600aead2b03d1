// WorldVisits: one world's visits on the main thread, from the loop's notes to sheets on their way to the disk.
#pragma once

#include <memory>
#include <string>

#include "server/visits/visit_feed.hpp"
#include "server/visits/visit_observer.hpp"
#include "server/visits/visit_sheets.hpp"

namespace mechane::app {

/// Main thread only, but for feed(), which the loop pushes to. The sheets outlive it.
class WorldVisits {
 public:
  /// Of a world that does not run yet. `resumed`: it goes on where a server's stop cut it off, and so does its visit's sheet.
  WorldVisits(visits::VisitSheets& sheets, const std::shared_ptr<const state::WorldDescription>& description,
              const std::string& kiosk, const state::WorldState& state, bool resumed);

  [[nodiscard]] visits::VisitFeed& feed() { return feed_; }
  /// Takes what the loop has noted. Now and then, so that the feed does not run over.
  void look();
  /// A visitor's answer. Errors: another activity runs, or nobody was seen at it.
  [[nodiscard]] Expected<void> answer(const state::VisitAnswer& answer);
  /// The language that the kiosk speaks from now on: "el".
  void set_language(std::string language) { observer_.set_language(std::move(language)); }
  /// The loop has given the world back, and it closes. `cut`: the server stops; else the visitors left, for `went_on_to` where that is
  /// not empty.
  void close(visits::VisitEnding why, const std::string& went_on_to);

 private:
  void hand_over();

  visits::VisitSheets& sheets_;
  visits::VisitFeed feed_;
  visits::VisitObserver observer_;
};

}  // namespace mechane::app
