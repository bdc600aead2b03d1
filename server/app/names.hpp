// Events in words, for logs and terminals.
#pragma once

#include <string>

#include "server/state/description.hpp"
#include "server/state/event.hpp"

namespace mechane::app {

/// "user 0 grasped INNER", "step fill started".
[[nodiscard]] std::string describe_event(const state::WorldDescription& world, const state::Event& event);

}  // namespace mechane::app
