// Shows a recorded visit again as a world on the network, for one kiosk of a DDS domain of its own.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "server/app/visit_journal.hpp"
#include "server/base/error.hpp"
#include "server/state/description.hpp"
#include "server/world/world.hpp"

namespace mechane::app {

struct ShowOptions {
  std::uint32_t domain = 0;
  std::string kiosk;  ///< who may see it; the world and its server have this name, too
  double speed = 1;   ///< 1: as it was
};

/// Runs the journal as fast as it can to the visit's first tick, waits until a client of the kiosk is in the world, shows the visit, and
/// ends. What clients say changes nothing: the journal's hands and commands do. Blocks. Errors: those of replay(); timed_out (no client
/// came within 20 s); of the network.
[[nodiscard]] Expected<void> show_visit(const VisitTicks& visit,
                                        const std::shared_ptr<const state::WorldDescription>& description,
                                        world::WorldConfig config, const ShowOptions& options);

}  // namespace mechane::app
