// Which finger belongs to which hand, where several hands work in one picture: fingers on one thing are one hand, on
// different things different hands. Pure: no window, no network, no clock of its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "client-sdk/pointer/pointer_fingers.hpp"

namespace mechane::pointer {

/// Three of a kiosk's four hands can be fingers; the first is for a device.
inline constexpr std::size_t kMostFingerHands = 3;

struct HandOrder {
  std::size_t hand = 0;  ///< below kMostFingerHands
  HandRequest request;
};

class FingerHands {
 public:
  /// What an event of fingers or buttons means; other events are ignored. `on`: the thing that a press at this place can
  /// take; none: there is nothing to take. A finger on a thing that a hand has goes to this hand; on another thing, to a
  /// hand that has nothing; beside things, to the nearest hand that carries, as its second finger. `hands`: the state of
  /// each; those that are missing have nothing.
  [[nodiscard]] std::vector<HandOrder> take(const PointerEvent& event, std::optional<std::uint32_t> on,
                                            std::span<const HandState> hands);
  /// A finger of this hand tried to take something where there was nothing.
  void missed(std::size_t hand) { fingers_.at(hand).missed(); }
  /// See PointerFingers::pass.
  [[nodiscard]] std::vector<HandOrder> pass(double dt_s);
  /// The hand of a finger that is down; none: the finger has no hand.
  [[nodiscard]] std::optional<std::size_t> hand_of(FingerId finger) const;
  [[nodiscard]] bool has_finger(std::size_t hand) const { return fingers_.at(hand).any(); }
  /// The hand that a finger touched with last.
  [[nodiscard]] std::size_t latest() const { return latest_; }
  /// Whether the last press was on a thing for which no hand was left.
  [[nodiscard]] bool none_left() const { return refused_.has_value(); }

 private:
  std::vector<HandOrder> press(const PointerEvent& event, std::optional<std::uint32_t> on,
                               std::span<const HandState> hands);
  [[nodiscard]] std::optional<std::size_t> hand_for(const PointerEvent& press, std::optional<std::uint32_t> on,
                                                    std::span<const HandState> hands) const;
  [[nodiscard]] std::optional<std::size_t> nearest(const PointerEvent& press, std::span<const HandState> hands) const;

  std::array<PointerFingers, kMostFingerHands> fingers_;
  std::size_t latest_ = 0;
  std::optional<FingerId> refused_;  ///< the finger for which no hand was left
};

}  // namespace mechane::pointer
