// WorldVisits: one world's visits on the main thread, from the loop's notes to sheets on their way to the disk.
#pragma once

#include <memory>
#include <string>

#include "server/record/visit_feed.hpp"
#include "server/record/visit_observer.hpp"
#include "server/record/visit_sheets.hpp"

namespace mechane::app {

/// Main thread only, but for feed(), which the loop pushes to. The sheets outlive it.
class WorldVisits {
 public:
  /// Of a world that does not run yet. `resumed`: it goes on where a server's stop cut it off, and so does its visit's sheet.
  WorldVisits(record::VisitSheets& sheets, const std::shared_ptr<const state::WorldDescription>& description,
              const std::string& kiosk, const state::WorldState& state, bool resumed);

  [[nodiscard]] record::VisitFeed& feed() { return feed_; }
  /// Takes what the loop has noted. Now and then, so that the feed does not run over.
  void look();
  /// A visitor's answer. Errors: the activity does not ask that, or it is none of its answers.
  [[nodiscard]] Expected<void> answer(const record::VisitAnswer& answer);
  /// The language that the kiosk speaks from now on: "el".
  void set_language(std::string language) { observer_.set_language(std::move(language)); }
  /// The loop has given the world back, and it closes. `cut`: the server stops; else the visitors left, for `went_on_to` where that is
  /// not empty.
  void close(record::VisitEnding why, const std::string& went_on_to);

 private:
  void hand_over();

  record::VisitSheets& sheets_;
  record::VisitFeed feed_;
  record::VisitObserver observer_;
};

}  // namespace mechane::app
