#include "client-sdk/pointer/pointer_hands.hpp"

namespace mechane::pointer {
namespace {

bool works(const PointerView& view) {
  return view.phase == PointerView::Phase::reaching || view.phase == PointerView::Phase::holding;
}

}  // namespace

std::vector<HandOrder> PointerHands::take(const PointerEvent& event, std::optional<std::uint32_t> on,
                                          picture::PixelSize picture, std::optional<std::size_t> aside) {
  std::array<HandState, kMostFingerHands> states;
  for (std::size_t hand = 0; hand < states.size(); ++hand)
    states[hand] = hand == aside ? HandState{false, false, picture} : state_of(view(hand), picture);
  return fingers_.take(event, on, states);
}

PointerTouch* PointerHands::made(std::size_t hand) {
  if (!hands_.at(hand)) hands_[hand] = make_();
  return hands_[hand].get();
}

PointerView PointerHands::view(std::size_t hand) const {
  return at(hand) == nullptr ? PointerView() : at(hand)->view();
}

std::optional<std::size_t> PointerHands::idle() const {
  for (std::size_t hand = 0; hand < hands_.size(); ++hand)
    if (!works(view(hand))) return hand;
  return {};
}

bool PointerHands::all_rest() const {
  for (std::size_t hand = 0; hand < hands_.size(); ++hand)
    if (view(hand).phase != PointerView::Phase::resting) return false;
  return true;
}

PointerLinkState PointerHands::state(std::size_t hand) const {
  if (fingers_.none_left() && hand == fingers_.latest()) return PointerLinkState::refused;
  return at(hand) == nullptr ? PointerLinkState::none : at(hand)->state();
}

std::vector<std::size_t> PointerHands::shown() const {
  const std::size_t latest = fingers_.latest();
  const auto moves = [&](std::size_t hand) { return view(hand).phase != PointerView::Phase::resting; };
  std::vector<std::size_t> shown;
  if (moves(latest) || fingers_.has_finger(latest)) shown.push_back(latest);
  for (std::size_t hand = 0; hand < hands_.size(); ++hand)
    if (hand != latest && moves(hand)) shown.push_back(hand);
  if (shown.empty() && at(latest) != nullptr) shown.push_back(latest);
  return shown;
}

}  // namespace mechane::pointer
