// Connects the display's thread, which has the pointer's events and shows the hand, with the hand's thread, which moves
// it 500 times a second. Neither ever waits for the other: events go through a ring, the hand comes back through a
// mailbox.
#pragma once

#include <cstdint>
#include <deque>

#include "client-sdk/pointer/pointer_hand.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/realtime/ring.hpp"
#include "server/realtime/wakeup.hpp"

namespace mechane::pointer {

/// The state of the hand's link to the server.
enum class PointerLinkState : std::uint8_t {
  none,     ///< nobody has touched for a while: no session
  waiting,  ///< for the server
  joined,
  refused,  ///< all hands of the kiosk are in use
};

/// One call of PointerHand.
struct PointerAct {
  enum class Kind : std::uint8_t { press, move, deepen, turn, release };
  Kind kind = Kind::release;
  picture::PixelPlace place{};  ///< press, move
  double amount = 0;            ///< deepen, turn
  picture::Sight sight{};       ///< press
  picture::Touched touched{};   ///< press
  void apply_to(PointerHand& hand) const;
};

class PointerExchange {
 public:
  PointerExchange() = default;
  PointerExchange(const PointerExchange&) = delete;
  PointerExchange& operator=(const PointerExchange&) = delete;

  // For the display's thread.

  void act(const PointerAct& act);
  /// The hand after all acts: those that the hand's thread has not taken yet are applied here to a copy.
  [[nodiscard]] PointerView view();
  [[nodiscard]] PointerLinkState state();

  // For the hand's thread.

  /// Applies the display's acts since the last call.
  void take_acts();
  /// The hand of this thread; publish() shows it to the display.
  [[nodiscard]] PointerHand& hand() { return hand_; }
  [[nodiscard]] bool resting() const { return hand_.view().phase == PointerView::Phase::resting; }
  void publish(PointerLinkState state);
  /// Sleeps until there is an act, wake() is called, or `timeout` has passed.
  void wait(Duration timeout) { (void)wakeup_.wait(timeout); }

  /// Any thread.
  void wake() { wakeup_.signal(); }

 private:
  struct Shown {
    PointerHand hand;
    PointerLinkState state = PointerLinkState::none;
    std::uint64_t taken = 0;  ///< number of acts that it includes
  };
  void send();
  const Shown& newest();

  realtime::Ring<PointerAct> acts_{256};
  realtime::Mailbox<Shown> shown_;
  realtime::Wakeup wakeup_;
  // Used by the display's thread only.
  std::deque<PointerAct> not_taken_;  ///< acts that newest() does not include yet
  std::uint64_t acted_ = 0;           ///< number of acts
  std::uint64_t sent_ = 0;            ///< number of acts sent into the ring; when it is full, the rest follows later
  Shown before_;                      ///< the value of newest() before anything was published
  // Used by the hand's thread only.
  PointerHand hand_;
  std::uint64_t taken_ = 0;
};

}  // namespace mechane::pointer
