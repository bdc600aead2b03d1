// What people do with a mouse, a finger on glass or keys, as a window tells it.
#pragma once

#include <cstdint>

namespace mechane::display {

/// Keys that move the hand.
enum class PointerKey : std::uint8_t { left, right, up, down, farther, nearer, take, next, previous };

/// One event, in the order in which things happened.
struct PointerEvent {
  enum class Kind : std::uint8_t {
    press,    ///< the left button, or the first finger
    release,  ///< of it
    move,
    wheel,  ///< amount: notches, away from the person above 0
    left,   ///< the pointer left the window
    key_down,
    key_up,
  };
  Kind kind = Kind::move;
  double x = 0;  ///< press, release, move: pixels of the picture, (0, 0) the upper left corner
  double y = 0;
  double amount = 0;
  PointerKey key = PointerKey::take;
};

}  // namespace mechane::display
