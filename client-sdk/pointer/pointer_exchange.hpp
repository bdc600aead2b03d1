// The display's hand between two threads: the display says what was done with the pointer and sees where the hand is; the hand's thread moves
// it 500 times a second. Neither ever waits for the other: what was done goes through a ring, the hand comes back through a mailbox.
#pragma once

#include <cstdint>
#include <deque>

#include "client-sdk/pointer/pointer_hand.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/realtime/ring.hpp"
#include "server/realtime/wakeup.hpp"

namespace mechane::pointer {

/// How the hand stands with the server.
enum class PointerLinkState : std::uint8_t {
  none,     ///< nobody touched for a while: no session
  waiting,  ///< for the server
  joined,
  refused,  ///< every hand of the kiosk has an owner
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

  // The display's thread.

  void act(const PointerAct& act);
  /// As it is once all acts are done: those that the hand's thread has not taken yet are done here, on a copy of its hand.
  [[nodiscard]] PointerView view();
  [[nodiscard]] PointerLinkState state();

  // The hand's thread.

  /// Does what the display asked for since the last call.
  void take_acts();
  /// That thread's own; publish() shows it to the display.
  [[nodiscard]] PointerHand& hand() { return hand_; }
  [[nodiscard]] bool resting() const { return hand_.view().phase == PointerView::Phase::resting; }
  void publish(PointerLinkState state);
  /// Sleeps until something was done, or wake() was called, or `timeout` has passed.
  void wait(Duration timeout) { (void)wakeup_.wait(timeout); }

  /// Any thread.
  void wake() { wakeup_.signal(); }

 private:
  struct Shown {
    PointerHand hand;
    PointerLinkState state = PointerLinkState::none;
    std::uint64_t taken = 0;  ///< acts that it contains
  };
  void send();
  const Shown& newest();

  realtime::Ring<PointerAct> acts_{256};
  realtime::Mailbox<Shown> shown_;
  realtime::Wakeup wakeup_;
  // The display's.
  std::deque<PointerAct> not_taken_;  ///< as far as newest() tells
  std::uint64_t acted_ = 0;           ///< how many acts there were
  std::uint64_t sent_ = 0;            ///< of them, into the ring: a full one takes the rest later
  Shown before_;                      ///< what newest() is before anything was published
  // The hand's thread's.
  PointerHand hand_;
  std::uint64_t taken_ = 0;
};

}  // namespace mechane::pointer
