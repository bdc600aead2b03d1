// What the journal keeps of one tick.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "server/state/event.hpp"
#include "server/state/input.hpp"

namespace mechane::record {

/// Ticks between two state hashes in a journal.
inline constexpr std::uint64_t kHashInterval = 1000;

/// A tick on its way into a journal: a view, good for the length of the call that takes it.
struct TickRecord {
  std::uint64_t tick = 0;                     ///< consecutive: a number left out counts as lost
  const state::TickInputs* inputs = nullptr;  ///< never null
  std::span<const state::Event> events;       ///< at most state::kMaxEventsPerTick
  std::optional<std::uint64_t> hash;          ///< state_hash after the tick; every kHashInterval ticks
};

/// A tick out of a journal. Inputs are bit for bit what the tick took in, with two exceptions that no tick may depend on: the
/// sample of a user who is present but not fresh is the last fresh one of the journal, and an absent user is default-made.
struct JournalTick {
  std::uint64_t tick = 0;
  state::TickInputs inputs;
  std::vector<state::Event> events;
  std::optional<std::uint64_t> hash;
  bool after_loss = false;  ///< ticks before this one are missing: a replay cannot go on to here
};

}  // namespace mechane::record
