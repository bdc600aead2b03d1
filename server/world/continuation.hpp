// Whether a world that runs can go on with an edited scenario, as an author changes it: from the state that it is in.
#pragma once

#include <memory>
#include <string>

#include "server/base/error.hpp"
#include "server/state/description.hpp"
#include "server/world/world.hpp"

namespace mechane::world {

/// What keeps a state of the one scenario from being a state of the other.
struct Obstacle {
  enum class Kind {
    none,
    steps,   ///< activities or steps have come or gone, or have another order; or this one switches other things
    bodies,  ///< they have come or gone, or have another order
    body,    ///< this one begins elsewhere, or is now fixed, visible or graspable otherwise
    start    ///< something else begins otherwise: a joint, an agent, a machine, an event
  };
  Kind kind = Kind::none;
  std::string name{};  ///< of the step or the body; empty: several
};

/// The word for a kind: "none", "steps" ...
[[nodiscard]] std::string_view word_of(Obstacle::Kind kind);

/// Both must begin with the same state, and a visit must be able to be at the same place in both. What touch feels, masses, shapes, what
/// agents and machines do, rules and texts may differ. It makes a world of each. Errors: those of World::create() for `next`.
[[nodiscard]] Expected<Obstacle> obstacle_between(const std::shared_ptr<const state::WorldDescription>& now,
                                                  const std::shared_ptr<const state::WorldDescription>& next,
                                                  const WorldConfig& config);

}  // namespace mechane::world
