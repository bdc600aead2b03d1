#include "client-sdk/gateway/browsers/browser_hand.hpp"

#include <algorithm>

namespace mechane::gateway {

using pointer::HandRequest;
using pointer::PointerEvent;

namespace {

/// Whether hands can take it now.
bool can_take(const pointer::PointerWorld& world, std::uint32_t index) {
  const client::SceneObject* object = pointer::object_of(world.objects, index);
  const auto senses = pointer::senses_of(world, index, false);
  return object != nullptr && object->movable && senses && senses->leeway.taken;
}

}  // namespace

void BrowserHand::take(const PointerMessage& message, const pointer::PointerWorld& world) {
  sight_ = message.sight;
  for (const PointerMessage::One& one : message.events)
    take_one(one, message.sight, world);
}

void BrowserHand::take_one(const PointerMessage::One& one, const picture::Sight& sight,
                           const pointer::PointerWorld& world) {
  const PointerEvent& event = one.event;
  if (event.kind == PointerEvent::Kind::wheel) {
    if (auto* hand = hands_.meant(event.finger)) hand->deepen(pointer::kNotch * event.amount);
    return;
  }
  if (event.kind == PointerEvent::Kind::turn_wheel) {
    if (auto* hand = hands_.meant(event.finger)) hand->turn(pointer::kNotchTurn_rad * event.amount);
    return;
  }
  std::optional<std::uint32_t> on;
  if (event.kind == PointerEvent::Kind::press) {
    means_ = event.finger == pointer::kMouse ? pointer::PointerMeans::mouse : pointer::PointerMeans::fingers;
    if (one.pick && can_take(world, one.pick->object)) on = one.pick->object;
  }
  for (const auto& [hand, request] : hands_.take(event, on, sight.picture)) {
    if (request.kind == HandRequest::Kind::take) {
      if (!on || !press(hand, one, request.place, sight)) hands_.missed(hand);
    } else if (hands_.at(hand) != nullptr) {
      pointer::fulfil(request, *hands_.at(hand));
    }
  }
}

/// Returns false where no hand is free to take it.
bool BrowserHand::press(std::size_t hand, const PointerMessage::One& one, picture::PixelPlace place,
                        const picture::Sight& sight) {
  pointer::PointerTouch* const touch = hands_.made(hand);
  if (touch == nullptr) return false;
  touch->press(sight, place, *one.pick);
  return true;
}

void BrowserHand::pass(double dt_s) {
  for (const auto& [hand, request] : hands_.pass(dt_s))
    if (hands_.at(hand) != nullptr) pointer::fulfil(request, *hands_.at(hand));
}

void BrowserHand::release() {
  PointerEvent gone;
  gone.kind = PointerEvent::Kind::gone;
  (void)hands_.take(gone, {}, sight_.picture);
  for (std::size_t hand = 0; hand < pointer::kMostFingerHands; ++hand)
    if (hands_.at(hand) != nullptr) hands_.at(hand)->release();
}

std::vector<HandTold> BrowserHand::told() const {
  std::vector<HandTold> told;
  for (const std::size_t hand : hands_.shown())
    told.push_back({hands_.view(hand), hands_.state(hand)});
  return told;
}

std::string BrowserHand::note(const std::string& language) const {
  picture::OverlayContent content;
  for (const HandTold& hand : told())
    pointer::add_pointer_aid({sight_, hand.view, {}, {}, hand.link, means_}, language, content);
  return content.note;
}

}  // namespace mechane::gateway
