// Which fingers are down, and what they mean together: the first takes and carries; a second turns the carried thing,
// and brings it nearer or farther. The mouse is a finger whose right button turns. Pure: no window, no network, no
// clock of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/pointer/pointer_event.hpp"

namespace mechane::pointer {

/// What the hand should do next.
struct HandRequest {
  enum class Kind : std::uint8_t { take, move, twist, deepen, release };
  Kind kind = Kind::move;
  picture::PixelPlace place{};  ///< take, move: pixels of the whole picture
  /// twist: radians, positive clockwise; deepen: logarithm of the distance's growth (log(1.1): a tenth farther).
  double amount = 0;
};

/// The state of the hand, as far as it matters for fingers.
struct HandState {
  bool busy = false;     ///< it reaches or holds
  bool carries = false;  ///< the held thing moves freely, not around an axle or along a track
  picture::PixelSize picture;
  std::optional<std::uint32_t> object{};  ///< what it reaches for or holds
};

/// Makes the hand's motions free of jumps: a finger moves the hand by as much as it moves itself.
class PointerFingers {
 public:
  /// What an event of fingers or buttons means; other events are ignored.
  [[nodiscard]] std::vector<HandRequest> take(const PointerEvent& event, const HandState& hand);
  /// A finger tried to take something where there was nothing: it is ignored until it is lifted.
  void missed() { first_.reset(); }
  /// A finger without events for half a minute was lifted unnoticed. The mouse may rest for any time.
  [[nodiscard]] std::vector<HandRequest> pass(double dt_s);
  [[nodiscard]] bool any() const { return first_.has_value(); }
  /// Whether this finger is down and the hand's.
  [[nodiscard]] bool has(FingerId id) const { return (first_ && first_->id == id) || (second_ && second_->id == id); }
  /// Where the hand's only finger is; none: it has none or two, or the mouse.
  [[nodiscard]] std::optional<picture::PixelPlace> single_finger_at() const {
    return first_ && !second_ && first_->id != kMouse ? std::optional(first_->at) : std::nullopt;
  }

 private:
  struct Finger {
    FingerId id = kMouse;
    picture::PixelPlace at;
    double silent_s = 0;
  };
  std::vector<HandRequest> press(const PointerEvent& event, const HandState& hand);
  std::vector<HandRequest> lift(FingerId id);
  std::vector<HandRequest> move(const PointerEvent& event, const HandState& hand);
  std::vector<HandRequest> move_pair(Finger& moved, picture::PixelPlace to, const HandState& hand);
  HandRequest go_by(double dx, double dy);

  std::optional<Finger> first_, second_;
  picture::PixelPlace hand_;  // where the hand should be
  bool turning_ = false;      // the right button is held
};

}  // namespace mechane::pointer
