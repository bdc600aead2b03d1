// One browser's hand: from its pointer's events, with what its rays hit, to a hand of the kiosk, by the rules of the native
// display's pointer. On the loop's thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "client-sdk/gateway/browser_message.hpp"
#include "client-sdk/pointer/pointer_aid.hpp"
#include "client-sdk/pointer/pointer_fingers.hpp"
#include "client-sdk/pointer/pointer_link.hpp"

namespace mechane::gateway {

/// Makes the hand when it is first needed; may give null.
using MakeHand = std::function<std::unique_ptr<pointer::PointerTouch>()>;

class BrowserHand {
 public:
  explicit BrowserHand(MakeHand make) : make_(std::move(make)) {}

  /// `world`: as it is now; only what hands can take now is taken, wherever the browser's ray went.
  void take(const PointerMessage& message, const pointer::PointerWorld& world);
  /// Releases fingers that were lifted unnoticed.
  void pass(double dt_s);
  /// The browser is gone, or another world is shown.
  void release();

  /// None before the first press.
  [[nodiscard]] std::optional<pointer::PointerView> view();
  [[nodiscard]] pointer::PointerLinkState link() { return hand_ ? hand_->state() : pointer::PointerLinkState::none; }
  /// What a visitor should know of this hand, in Greek or English; empty: nothing.
  [[nodiscard]] std::string note(const std::string& language);
  /// For somebody who may wait for its thread to end.
  [[nodiscard]] std::unique_ptr<pointer::PointerTouch> take_away() { return std::move(hand_); }

 private:
  void take_one(const PointerMessage::One& one, const picture::Sight& sight, const pointer::PointerWorld& world);
  [[nodiscard]] bool press(const PointerMessage::One& one, picture::PixelPlace place, const picture::Sight& sight,
                           const pointer::PointerWorld& world);
  MakeHand make_;
  std::unique_ptr<pointer::PointerTouch> hand_;
  pointer::PointerFingers fingers_;
  picture::Sight sight_;
  pointer::PointerMeans means_ = pointer::PointerMeans::mouse;
};

}  // namespace mechane::gateway
