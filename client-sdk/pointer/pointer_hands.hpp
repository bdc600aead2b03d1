// The hands of one picture: fingers are shared out among them, see FingerHands, and each is made when it is first needed.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "client-sdk/pointer/finger_hands.hpp"
#include "client-sdk/pointer/pointer_link.hpp"

namespace mechane::pointer {

/// Makes a hand; may give null.
using MakeHand = std::function<std::unique_ptr<PointerTouch>()>;

/// On one thread: that of its hands' functions.
class PointerHands {
 public:
  explicit PointerHands(MakeHand make) : make_(std::move(make)) {}

  /// See FingerHands::take. `aside`: a hand that keys use, which a finger may take over.
  [[nodiscard]] std::vector<HandOrder> take(const PointerEvent& event, std::optional<std::uint32_t> on,
                                            picture::PixelSize picture, std::optional<std::size_t> aside = {});
  [[nodiscard]] std::vector<HandOrder> pass(double dt_s) { return fingers_.pass(dt_s); }
  void missed(std::size_t hand) { fingers_.missed(hand); }

  /// Null where it could not be made.
  [[nodiscard]] PointerTouch* made(std::size_t hand);
  /// Null while it was never needed.
  [[nodiscard]] PointerTouch* at(std::size_t hand) const { return hands_.at(hand).get(); }
  /// Resting where it was never needed.
  [[nodiscard]] PointerView view(std::size_t hand) const;
  /// A hand that neither reaches nor holds; none: all do.
  [[nodiscard]] std::optional<std::size_t> idle() const;
  [[nodiscard]] bool all_rest() const;
  [[nodiscard]] std::optional<std::size_t> hand_of(FingerId finger) const { return fingers_.hand_of(finger); }
  /// The hand that a wheel means: this finger's, else the one that was used last. Null while it was never needed.
  [[nodiscard]] PointerTouch* meant(FingerId finger) const {
    return at(fingers_.hand_of(finger).value_or(fingers_.latest()));
  }
  /// `refused` where a finger found no hand left.
  [[nodiscard]] PointerLinkState state(std::size_t hand) const;
  /// What to show: the hands that do not rest, and the one that was used last while its finger is down, or else if there
  /// is no other. The one that was used last comes first. Empty before the first use.
  [[nodiscard]] std::vector<std::size_t> shown() const;

  /// For somebody who may wait for their threads to end.
  [[nodiscard]] std::array<std::unique_ptr<PointerTouch>, kMostFingerHands> take_away() { return std::move(hands_); }

 private:
  MakeHand make_;
  FingerHands fingers_;
  std::array<std::unique_ptr<PointerTouch>, kMostFingerHands> hands_;
};

}  // namespace mechane::pointer
