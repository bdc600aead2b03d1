// VisitFeed: the queue of events from a world's loop to its VisitObserver.
#pragma once

#include <atomic>
#include <cstdint>

#include "server/realtime/ring.hpp"
#include "server/state/event.hpp"
#include "server/state/input.hpp"
#include "server/state/world_state.hpp"

namespace mechane::visits {

/// An event that a visit record may need, with what only the loop knows at that moment.
struct VisitNote {
  state::Event event;
  state::CommandKind command =
      state::CommandKind::none;  ///< of command_done and activity_started: the command that caused it
  bool opened_hand =
      false;  ///< of released: the hand opened, and no joint or rope holds the body, which falls or lies where it was put
};

/// A bounded queue from the loop to one other thread. When it is full, notes are lost and counted: a tick never waits.
class VisitFeed {
 public:
  static constexpr std::size_t kCapacity =
      1024;  ///< notes of some seconds of busy hands; the other thread takes them 50 times a second

  /// For the loop: notes the events of a tick. Wait-free, allocates nothing.
  void push(const state::WorldDescription& description, const state::WorldState& state,
            const state::TickInputs& inputs) noexcept;

  /// For the other thread.
  [[nodiscard]] bool take(VisitNote& out) noexcept { return notes_.pop(out); }
  /// The last tick that push() was called for. All its notes can be taken.
  [[nodiscard]] std::uint64_t tick() const noexcept { return tick_.load(std::memory_order_acquire); }
  [[nodiscard]] std::uint32_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  realtime::Ring<VisitNote> notes_{kCapacity};
  std::atomic<std::uint64_t> tick_{0};
  std::atomic<std::uint32_t> lost_{0};
};

}  // namespace mechane::visits
