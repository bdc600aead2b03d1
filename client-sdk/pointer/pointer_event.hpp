// A window's events from a mouse, fingers on glass or keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

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

/// Identifies a finger from its press to its release; each touch has a new number.
using FingerId = std::int64_t;
/// The mouse, which is always there.
constexpr FingerId kMouse = 0;

/// What a notch of the wheel does: the carried thing's distance grows by this share of it, or the held thing turns.
inline constexpr double kNotch = 0.03;
inline constexpr double kNotchTurn_rad = std::numbers::pi / 18;

/// One event; events come in the order in which they happened.
struct PointerEvent {
  enum class Kind : std::uint8_t {
    press,    ///< the left button, or a finger
    release,  ///< of it
    move,
    turn_press,    ///< the right button: the mouse's motion turns the held thing
    turn_release,  ///< of it
    wheel,         ///< amount: notches; above 0: away from the person
    turn_wheel,    ///< the wheel with Shift held
    left,          ///< the mouse left the window
    gone,          ///< all fingers and buttons are released: the window receives no more of their events
    key_down,
    key_up,
  };
  Kind kind = Kind::move;
  double x = 0;  ///< for buttons, fingers and motions: pixels of the picture, (0, 0) is the upper left corner
  double y = 0;
  double amount = 0;
  PointerKey key = PointerKey::take;
  FingerId finger = kMouse;
};

}  // namespace mechane::pointer
