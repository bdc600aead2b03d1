#include "server/app/world_visits.hpp"

#include <utility>

namespace mechane::app {

WorldVisits::WorldVisits(visits::VisitWriter* writer, const std::shared_ptr<const state::WorldDescription>& description,
                         const std::string& kiosk, const state::WorldState& state, bool resumed)
    : writer_(writer),
      observer_(
          description, kiosk, state.progress, state.tick,
          resumed && writer != nullptr ? writer->take_unfinished(kiosk, description->content_hash) : std::nullopt) {}

void WorldVisits::look() {
  const std::uint64_t tick = feed_.tick();  // read before the notes, so that all notes of this tick are in the queue
  const std::uint32_t lost = feed_.lost();
  visits::VisitNote note;
  while (feed_.take(note))
    observer_.take(note);
  observer_.look(tick, lost);
  hand_over();
}

Expected<void> WorldVisits::answer(const state::VisitAnswer& answer) {
  look();
  auto taken = observer_.answer(answer);
  hand_over();
  return taken;
}

void WorldVisits::close(visits::VisitEnding why, const std::string& went_on_to) {
  look();
  observer_.close(why, went_on_to);
  hand_over();
}

void WorldVisits::hand_over() {
  for (visits::VisitRecord& record : observer_.take_changed())
    if (writer_ != nullptr) writer_->put(std::move(record));
}

}  // namespace mechane::app
