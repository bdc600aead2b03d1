// A world's state as bytes: what a restarted server resumes from. Versioned and checksummed; a damaged one is an error, not a crash.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "server/base/error.hpp"
#include "server/state/world_state.hpp"

namespace mechane::state {

/// Everything that the next tick reads, except what the dynamics engine keeps inside (contact caches, warm starts). Because of that
/// exception a resume starts a new journal segment. `out` is overwritten; it allocates only when its capacity is too small.
void write_snapshot(const WorldState& state, std::vector<std::byte>& out, StateVersion version = kStateVersion);

/// Fills a state that was made from the same description. Errors: damaged, wrong_version, conflict (tables of other sizes: another
/// scenario); the state then stays as it was.
[[nodiscard]] Expected<void> read_snapshot(std::span<const std::byte> bytes, WorldState& state);

}  // namespace mechane::state
