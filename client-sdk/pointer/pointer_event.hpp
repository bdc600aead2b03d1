// What people do with a mouse, fingers on glass or keys, as a window tells it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mechane::pointer {

/// Keys that move the hand.
enum class PointerKey : std::uint8_t {
  left,
  right,
  up,
  down,
  farther,
  nearer,
  take,
  next,
  previous,
  turn_left,
  turn_right
};
constexpr std::size_t kPointerKeys = 11;

/// A finger from its press to its release; no two touches have the same.
using FingerId = std::int64_t;
/// The mouse, which is always there.
constexpr FingerId kMouse = 0;

/// One event, in the order in which things happened.
struct PointerEvent {
  enum class Kind : std::uint8_t {
    press,    ///< the left button, or a finger
    release,  ///< of it
    move,
    turn_press,    ///< the right button: the mouse's way turns what is held
    turn_release,  ///< of it
    wheel,         ///< amount: notches, away from the person above 0
    turn_wheel,    ///< the wheel with Shift held
    left,          ///< the mouse left the window
    gone,          ///< all fingers and buttons: the window hears no more of them
    key_down,
    key_up,
  };
  Kind kind = Kind::move;
  double x = 0;  ///< of buttons, fingers and motions: pixels of the picture, (0, 0) the upper left corner
  double y = 0;
  double amount = 0;
  PointerKey key = PointerKey::take;
  FingerId finger = kMouse;
};

}  // namespace mechane::pointer
