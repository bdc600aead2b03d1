// What a display shows of a played exhibit, and the visitor's player with a mouse for PlayOptions::make_person: it moves the hand of a
// display without threads, network and window.
#pragma once

#include <memory>

#include "client-sdk/visitor/shown_exhibit.hpp"
#include "tests/support/exhibit_play.hpp"

namespace mechane::test {

/// The picture of an exhibit; to be shared by its visits.
[[nodiscard]] std::unique_ptr<visitor::ShownExhibit> show_exhibit(const state::WorldDescription& description);

/// What a display of a world would know of it now: bodies, quantities, hands, and the enabled agents.
void show(const state::WorldState& state, const state::WorldDescription& description, client::Frame& frame,
          client::WorldStatus& status);

/// Both outlive the person.
[[nodiscard]] std::unique_ptr<Person> make_pointer_person(visitor::ShownExhibit& shown,
                                                          const state::WorldDescription& description,
                                                          const state::VisitDescription& visit);

}  // namespace mechane::test
