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

/// A tick on its way into a journal: a view, valid during the call that takes it.
struct TickRecord {
  std::uint64_t tick = 0;                     ///< consecutive; a number that is skipped counts as a lost tick
  const state::TickInputs* inputs = nullptr;  ///< never null
  std::span<const state::Event> events;       ///< at most state::kMaxEventsPerTick
  std::optional<std::uint64_t> hash;          ///< state_hash after the tick; every kHashInterval ticks
};

/// A tick from a journal. The inputs have the bits that the tick was given, with two exceptions on which no tick may depend: a user who is
/// present but not fresh has the journal's last fresh sample, and an absent user has default values.
struct JournalTick {
  std::uint64_t tick = 0;
  state::TickInputs inputs;
  std::vector<state::Event> events;
  std::optional<std::uint64_t> hash;
  bool after_loss = false;  ///< ticks before this one are missing: a replay must end before it
};

}  // namespace mechane::record
