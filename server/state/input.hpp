// What a tick takes in. Everything that a tick's result depends on is here, so that a journal of these replays a visit to the bit.
#pragma once

#include <array>
#include <cstdint>

#include "server/base/clock.hpp"
#include "server/hand/hand_sample.hpp"
#include "server/state/limits.hpp"

namespace mechane::state {

/// What the server knows of one user at the start of a tick.
struct UserInput {
  bool present = false;  ///< a session owns this hand
  bool fresh = false;    ///< `sample` has a new sequence number since the last tick
  Duration age{0};       ///< since the last new sequence number arrived, on the server's clock
  hand::SentSample sample;
};

enum class CommandKind : std::uint8_t { none = 0, start_activity = 1, restart_activity = 2, next_step = 3, click = 4 };

/// A request of a person or a program, answered by id with an event.
struct Command {
  std::uint64_t id = 0;
  CommandKind kind = CommandKind::none;
  std::uint32_t argument = 0;  ///< start_activity: ActivityId's index; click: BodyId's
};

struct TickInputs {
  std::array<UserInput, hand::kMaxUsers> users{};
  std::array<Command, kMaxCommandsPerTick> commands{};
  std::uint32_t command_count = 0;
};

}  // namespace mechane::state
