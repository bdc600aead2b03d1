// What happened in a tick, for displays, records and people.
#pragma once

#include <cstdint>

namespace mechane::state {

enum class EventKind : std::uint8_t {
  none = 0,
  user_joined = 1,        ///< subject: user
  user_left = 2,          ///< subject: user
  input_stale = 3,        ///< subject: user; the hand is frozen, forces decay
  input_back = 4,         ///< subject: user
  touched = 5,            ///< subject: user, object: body
  grasped = 6,            ///< subject: user, object: body
  released = 7,           ///< subject: user, object: body
  placed = 8,             ///< subject: agent, object: body
  turned = 9,             ///< subject: agent; value: whole turns so far
  step_started = 10,      ///< subject: step
  activity_started = 11,  ///< subject: activity
  activity_done = 12,     ///< subject: activity; value: seconds it took
  spilled = 13,           ///< subject: machine; value: m^3 that ran off since the last such event
  command_done = 14,      ///< value: the command's id
  command_refused = 15,   ///< value: the command's id
  pulled = 16,            ///< subject: agent, object: body
  pushed = 17,            ///< subject: agent, object: body
  lit = 18,               ///< subject: agent, object: body
  fired = 19,             ///< subject: agent, object: body
  assembled = 20,         ///< subject: agent; every part is in its place
  part_refused = 21,      ///< subject: agent, object: body that came to its place before its turn
  dwelt = 22,             ///< subject: agent; value: seconds
  pointed = 23,           ///< subject: agent, object: body; value: user, -1: by a click
  idled = 24,             ///< subject: agent; value: seconds
  broke = 25,             ///< subject: agent; value: the force, N, or where that is whole, the torque, N m
};

/// Ids are indices into the tables of WorldDescription; 0xffffffff where there is none.
struct Event {
  std::uint64_t tick = 0;
  EventKind kind = EventKind::none;
  std::uint32_t subject = 0xffffffffu;
  std::uint32_t object = 0xffffffffu;
  double value = 0;
};

}  // namespace mechane::state
