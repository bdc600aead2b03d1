// One browser's hands: from its pointer's events, with what its rays hit, to hands of the kiosk, by the rules of the native
// display's pointer. On the loop's thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client-sdk/gateway/browsers/browser_message.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"
#include "client-sdk/pointer/pointer_hands.hpp"

namespace mechane::gateway {

/// What a page is told of a hand.
struct HandTold {
  pointer::PointerView view;
  pointer::PointerLinkState link = pointer::PointerLinkState::none;
};

class BrowserHand {
 public:
  explicit BrowserHand(pointer::MakeHand make) : hands_(std::move(make)) {}

  /// `world`: as it is now; only what hands can take now is taken, wherever the browser's ray went.
  void take(const PointerMessage& message, const pointer::PointerWorld& world);
  /// Releases fingers that were lifted unnoticed.
  void pass(double dt_s);
  /// The browser is gone, or another world is shown.
  void release();

  /// The hands to be shown, the one that was used last first; empty before the first press.
  [[nodiscard]] std::vector<HandTold> told() const;
  /// What a visitor should know of these hands, in Greek or English; empty: nothing.
  [[nodiscard]] std::string note(const std::string& language) const;
  /// For somebody who may wait for their threads to end.
  [[nodiscard]] auto take_away() { return hands_.take_away(); }

 private:
  void take_one(const PointerMessage::One& one, const picture::Sight& sight, const pointer::PointerWorld& world);
  [[nodiscard]] bool press(std::size_t hand, const PointerMessage::One& one, picture::PixelPlace place,
                           const picture::Sight& sight);
  pointer::PointerHands hands_;
  picture::Sight sight_;
  pointer::PointerMeans means_ = pointer::PointerMeans::mouse;
};

}  // namespace mechane::gateway
