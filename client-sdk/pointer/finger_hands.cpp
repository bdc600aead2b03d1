#include "client-sdk/pointer/finger_hands.hpp"

#include <cmath>
#include <limits>

namespace mechane::pointer {
namespace {

HandState state_at(std::span<const HandState> hands, std::size_t hand) {
  return hand < hands.size() ? hands[hand] : HandState();
}

void add(std::vector<HandOrder>& orders, std::size_t hand, const std::vector<HandRequest>& requests) {
  for (const HandRequest& request : requests)
    orders.push_back({hand, request});
}

}  // namespace

std::vector<HandOrder> FingerHands::take(const PointerEvent& event, std::optional<std::uint32_t> on,
                                         std::span<const HandState> hands) {
  using Kind = PointerEvent::Kind;
  if (event.kind == Kind::press) return press(event, on, hands);
  const bool of_all = event.kind == Kind::gone || event.kind == Kind::turn_press || event.kind == Kind::turn_release;
  if (event.kind == Kind::gone || (event.kind == Kind::release && refused_ == event.finger)) refused_.reset();
  std::vector<HandOrder> orders;
  for (std::size_t hand = 0; hand < fingers_.size(); ++hand)
    if (of_all || fingers_[hand].has(event.finger))
      add(orders, hand, fingers_[hand].take(event, state_at(hands, hand)));
  return orders;
}

std::vector<HandOrder> FingerHands::press(const PointerEvent& event, std::optional<std::uint32_t> on,
                                          std::span<const HandState> hands) {
  std::vector<HandOrder> orders;
  std::vector<HandState> now(hands.begin(), hands.end());
  if (const auto before = hand_of(event.finger)) {  // it was never lifted
    PointerEvent lift = event;
    lift.kind = PointerEvent::Kind::release;
    add(orders, *before, fingers_[*before].take(lift, state_at(now, *before)));
    if (!orders.empty() && *before < now.size()) now[*before] = {};
  }
  const auto hand = hand_for(event, on, now);
  refused_ = !hand && on ? std::optional(event.finger) : std::nullopt;
  if (!hand) return orders;
  latest_ = *hand;
  add(orders, *hand, fingers_[*hand].take(event, state_at(now, *hand)));
  return orders;
}

std::optional<std::size_t> FingerHands::hand_for(const PointerEvent& press, std::optional<std::uint32_t> on,
                                                 std::span<const HandState> hands) const {
  if (!on) {
    if (const auto beside = nearest(press, hands)) return beside;
  }
  std::optional<std::size_t> idle;
  for (std::size_t hand = 0; hand < fingers_.size(); ++hand) {
    const HandState state = state_at(hands, hand);
    if (on && state.busy && state.object == on) return hand;
    if (!state.busy && !idle) idle = hand;
  }
  return idle;
}

/// The hand whose fingers are nearest to this one, which comes down beside things.
std::optional<std::size_t> FingerHands::nearest(const PointerEvent& press, std::span<const HandState> hands) const {
  if (press.finger == kMouse) return {};
  std::optional<std::size_t> found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t hand = 0; hand < fingers_.size(); ++hand) {
    const auto at = fingers_[hand].single_finger_at();
    if (!at || !state_at(hands, hand).busy) continue;
    const double apart = std::hypot(at->x - press.x, at->y - press.y);
    if (!(apart < least)) continue;
    least = apart;
    found = hand;
  }
  return found;
}

std::vector<HandOrder> FingerHands::pass(double dt_s) {
  std::vector<HandOrder> orders;
  for (std::size_t hand = 0; hand < fingers_.size(); ++hand)
    add(orders, hand, fingers_[hand].pass(dt_s));
  return orders;
}

std::optional<std::size_t> FingerHands::hand_of(FingerId finger) const {
  for (std::size_t hand = 0; hand < fingers_.size(); ++hand)
    if (fingers_[hand].has(finger)) return hand;
  return {};
}

}  // namespace mechane::pointer
