// What a tick takes in. Everything that a tick's result depends on is here, so that a journal of these replays a visit to the bit.
#pragma once

#include <array>
#include <cstdint>

#include "server/base/clock.hpp"
#include "server/base/math.hpp"
#include "server/state/limits.hpp"

namespace mechane::state {

/// How a device shows the hand. A glove moves 16 segments; a one-point device (a stylus, a pointer) has one sphere at its tip.
enum class HandKind : std::uint8_t { one_point = 0, glove = 1 };

/// One sample of a device, already checked by the transport: all numbers finite, rotation of unit length.
struct HandSample {
  std::uint64_t session = 0;   ///< who sends: a client's own random number, never 0
  std::uint64_t sequence = 0;  ///< rises by one a sample within a session
  std::uint64_t sent_ns = 0;   ///< the sender's clock; echoed, never compared with ours
  HandKind kind = HandKind::one_point;
  Pose X_WH;                                 ///< wrist (glove) or tip (one-point) in W
  Twist V_WH;                                ///< its velocity, for damping
  std::array<double, kHandJoints> joints{};  ///< finger angles, radians (glove)
  double hand_scale = 1.0;                   ///< size of the visitor's hand against the model's (calibration)
  std::uint32_t buttons = 0;
  double grasp_intent = 0.0;  ///< 0 open .. 1 closed: a button, a pinch, or the glove's own estimate
};

/// What the server knows of one user at the start of a tick.
struct UserInput {
  bool present = false;  ///< a session owns this hand
  bool fresh = false;    ///< `sample` has a new sequence number since the last tick
  Duration age{0};       ///< since the last new sequence number arrived, on the server's clock
  HandSample sample;
};

enum class CommandKind : std::uint8_t { none = 0, start_activity = 1, restart_activity = 2, next_step = 3, click = 4 };

/// A wish of a person or a program, answered by id with an event.
struct Command {
  std::uint64_t id = 0;
  CommandKind kind = CommandKind::none;
  std::uint32_t argument = 0;  ///< start_activity: ActivityId's index; click: BodyId's
};

struct TickInputs {
  std::array<UserInput, kMaxUsers> users{};
  std::array<Command, kMaxCommandsPerTick> commands{};
  std::uint32_t command_count = 0;
};

}  // namespace mechane::state
