// Which fingers are down, and what they mean together: the first takes and carries; a second turns what is carried, and brings it nearer or
// takes it away. The mouse is a finger whose right button turns. Pure: no window, no network, no clock of its own.
#pragma once

#include <optional>
#include <vector>

#include "client-sdk/picture/pixels.hpp"
#include "client-sdk/pointer/pointer_event.hpp"

namespace mechane::pointer {

/// What the hand shall do next.
struct HandRequest {
  enum class Kind : std::uint8_t { take, move, twist, deepen, release };
  Kind kind = Kind::move;
  picture::PixelPlace place{};  ///< take, move: pixels of the whole picture
  double amount =
      0;  ///< twist: radians, as the hands of a clock go above 0; deepen: as a distance grows, above 0 shares (1.1 is log(1.1))
};

/// How the hand is, as far as fingers must know.
struct HandState {
  bool busy = false;     ///< it reaches or holds
  bool carries = false;  ///< what it holds goes anywhere, not round an axle nor along a track
  picture::PixelSize picture;
};

/// Between what fingers say and what the hand is told nothing jumps: a finger moves the hand by as much as it moves itself.
class PointerFingers {
 public:
  /// What an event of fingers or buttons means; other events mean nothing here.
  [[nodiscard]] std::vector<HandRequest> take(const PointerEvent& event, const HandState& hand);
  /// Where a finger tried to take something, there was nothing: until it is lifted it means nothing.
  void missed() { first_.reset(); }
  /// A finger that says nothing for half a minute has gone without a word. The mouse may rest as long as it likes.
  [[nodiscard]] std::vector<HandRequest> pass(double dt_s);
  [[nodiscard]] bool any() const { return first_.has_value(); }

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
  picture::PixelPlace hand_;  // where the hand is asked to be
  bool turning_ = false;      // the right button is held
};

}  // namespace mechane::pointer
