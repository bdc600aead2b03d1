#include "client-sdk/gateway/browser_hand.hpp"

#include <algorithm>

namespace mechane::gateway {

using pointer::HandRequest;
using pointer::PointerEvent;
using pointer::PointerView;

void BrowserHand::take(const PointerMessage& message, const pointer::PointerWorld& world) {
  sight_ = message.sight;
  for (const PointerMessage::One& one : message.events)
    take_one(one, message.sight, world);
}

void BrowserHand::take_one(const PointerMessage::One& one, const picture::Sight& sight,
                           const pointer::PointerWorld& world) {
  const PointerEvent& event = one.event;
  if (event.kind == PointerEvent::Kind::wheel) {
    if (hand_) hand_->deepen(pointer::kNotch * event.amount);
    return;
  }
  if (event.kind == PointerEvent::Kind::turn_wheel) {
    if (hand_) hand_->turn(pointer::kNotchTurn_rad * event.amount);
    return;
  }
  if (event.kind == PointerEvent::Kind::press)
    means_ = event.finger == pointer::kMouse ? pointer::PointerMeans::mouse : pointer::PointerMeans::fingers;
  const PointerView view = hand_ ? hand_->view() : PointerView{};
  for (const HandRequest& request : fingers_.take(event, pointer::state_of(view, sight.picture))) {
    if (request.kind == HandRequest::Kind::take) {
      if (!press(one, request.place, sight, world)) fingers_.missed();
    } else if (hand_) {
      pointer::fulfil(request, *hand_);
    }
  }
}

/// False: there is nothing to take.
bool BrowserHand::press(const PointerMessage::One& one, picture::PixelPlace place, const picture::Sight& sight,
                        const pointer::PointerWorld& world) {
  if (!one.pick) return false;
  const client::SceneObject* object = pointer::object_of(world.objects, one.pick->object);
  const auto senses = pointer::senses_of(world, one.pick->object, false);
  if (object == nullptr || !object->movable || !senses || !senses->leeway.taken) return false;
  if (!hand_) hand_ = make_();
  if (!hand_) return false;
  hand_->press(sight, place, *one.pick);
  return true;
}

void BrowserHand::pass(double dt_s) {
  for (const HandRequest& request : fingers_.pass(dt_s))
    if (hand_) pointer::fulfil(request, *hand_);
}

void BrowserHand::release() {
  PointerEvent gone;
  gone.kind = PointerEvent::Kind::gone;
  (void)fingers_.take(gone, {});
  if (hand_) hand_->release();
}

std::optional<PointerView> BrowserHand::view() {
  if (!hand_) return std::nullopt;
  return hand_->view();
}

std::string BrowserHand::note(const std::string& language) {
  if (!hand_) return {};
  picture::OverlayContent content;
  pointer::add_pointer_aid({sight_, hand_->view(), {}, {}, hand_->state(), means_}, language, content);
  return content.note;
}

}  // namespace mechane::gateway
