#include "client-sdk/pointer/pointer_exchange.hpp"

namespace mechane::pointer {

void PointerAct::apply_to(PointerHand& hand) const {
  switch (kind) {
    case Kind::press:
      return hand.press(sight, place, touched);
    case Kind::move:
      return hand.move(place);
    case Kind::deepen:
      return hand.deepen(amount);
    case Kind::turn:
      return hand.turn(amount);
    case Kind::release:
      return hand.release();
  }
}

void PointerExchange::act(const PointerAct& act) {
  not_taken_.push_back(act);
  ++acted_;
  send();
}

void PointerExchange::send() {
  const std::uint64_t first = acted_ - not_taken_.size();
  while (sent_ < acted_ && acts_.push(not_taken_[sent_ - first]))
    ++sent_;
  wake();
}

const PointerExchange::Shown& PointerExchange::newest() {
  const Shown* published = shown_.newest();
  const Shown& newest = published == nullptr ? before_ : *published;
  while (acted_ - not_taken_.size() < newest.taken)
    not_taken_.pop_front();
  if (sent_ < acted_) send();
  return newest;
}

PointerView PointerExchange::view() {
  const Shown& seen = newest();
  if (not_taken_.empty()) return seen.hand.view();
  PointerHand hand = seen.hand;
  for (const PointerAct& act : not_taken_)
    act.apply_to(hand);
  return hand.view();
}

PointerLinkState PointerExchange::state() {
  return newest().state;
}

void PointerExchange::take_acts() {
  for (const PointerAct* act = acts_.front(); act != nullptr; act = acts_.front()) {
    act->apply_to(hand_);
    acts_.pop();
    ++taken_;
  }
}

void PointerExchange::publish(PointerLinkState state) {
  shown_.publish({hand_, state, taken_});
}

}  // namespace mechane::pointer
