// WorldVisits: one world's visits on the main thread, from the loop's notes to records for the writer.
#pragma once

#include <memory>
#include <string>

#include "server/visits/visit_feed.hpp"
#include "server/visits/visit_observer.hpp"
#include "server/visits/visit_writer.hpp"

namespace mechane::app {

/// Main thread only, except for the feed, which the loop pushes to. The writer outlives it.
class WorldVisits {
 public:
  /// For a world that does not run yet. `writer` may be null: then visits are followed and not recorded. `resumed`: it
  /// continues where a former server stopped, and so does the record of its visit.
  WorldVisits(visits::VisitWriter* writer, const std::shared_ptr<const state::WorldDescription>& description,
              const std::string& kiosk, const state::WorldState& state, bool resumed);

  [[nodiscard]] visits::VisitFeed& feed() { return feed_; }
  /// Takes what the loop has noted. Call it often enough that the feed does not run full.
  void look();
  /// A visitor's answer. Errors: conflict (another activity is running, or there was no visitor).
  [[nodiscard]] Expected<void> answer(const state::VisitAnswer& answer);
  /// The kiosk's language from now on: "el".
  void set_language(std::string language) { observer_.set_language(std::move(language)); }
  /// Whether a visit is in progress, as of the last look().
  [[nodiscard]] bool visit_runs() const { return observer_.visit_runs(); }
  /// To be called when the loop has given the world back and it closes. `why`: cut, because the server stops, or left. `went_on_to`: the
  /// scenario that the visitors went on to, or empty.
  void close(visits::VisitEnding why, const std::string& went_on_to);

 private:
  void hand_over();

  visits::VisitWriter* writer_;
  visits::VisitFeed feed_;
  visits::VisitObserver observer_;
};

}  // namespace mechane::app
