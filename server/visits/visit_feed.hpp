// VisitFeed: from a world's loop to whoever keeps its visits' sheets.
#pragma once

#include <atomic>
#include <cstdint>

#include "server/realtime/ring.hpp"
#include "server/state/event.hpp"
#include "server/state/input.hpp"
#include "server/state/world_state.hpp"

namespace mechane::visits {

/// An event that a sheet may need, with what only the loop knows at that moment.
struct VisitNote {
  state::Event event;
  state::CommandKind command =
      state::CommandKind::none;  ///< of command_done, and of activity_started: whose doing it is
  bool opened_hand =
      false;  ///< released: by the hand, and no joint or rope holds the body: it falls, or lies where it was put
};

/// A bounded queue from the loop to one other thread. A full one loses notes and counts them: a tick never waits.
class VisitFeed {
 public:
  static constexpr std::size_t kCapacity =
      1024;  ///< notes: some seconds of busy hands; the other side looks 50 times a second

  /// Loop: takes what it needs of a tick. Wait-free, allocates nothing.
  void push(const state::WorldDescription& description, const state::WorldState& state,
            const state::TickInputs& inputs) noexcept;

  /// The other side.
  [[nodiscard]] bool take(VisitNote& out) noexcept { return notes_.pop(out); }
  /// The last tick that push() has seen. All its notes can be taken.
  [[nodiscard]] std::uint64_t tick() const noexcept { return tick_.load(std::memory_order_acquire); }
  [[nodiscard]] std::uint32_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  realtime::Ring<VisitNote> notes_{kCapacity};
  std::atomic<std::uint64_t> tick_{0};
  std::atomic<std::uint32_t> lost_{0};
};

}  // namespace mechane::visits
