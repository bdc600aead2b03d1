// The hands of one visitor in a headset: each a hand of the kiosk while it is seen.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <thread>

#include "client-sdk/gateway/browsers/tracked_message.hpp"
#include "client-sdk/gateway/browsers/tracked_motion.hpp"
#include "client-sdk/pointer/pointer_exchange.hpp"
#include "server/realtime/mailbox.hpp"
#include "server/realtime/wakeup.hpp"

namespace mechane::gateway {

/// One hand's session at the kiosk, on a thread of its own. It opens when the hand is first seen and ends when the hand has not been seen
/// for ten seconds. While the hand is not seen nothing is sent, so the server lets go of what it held.
class TrackedLink {
 public:
  TrackedLink(std::string kiosk, std::uint32_t domain);
  TrackedLink(const TrackedLink&) = delete;
  TrackedLink& operator=(const TrackedLink&) = delete;
  ~TrackedLink();

  // For the loop's thread; none waits.

  void take(const TrackedHand& seen);
  [[nodiscard]] pointer::PointerLinkState state() const { return state_; }
  [[nodiscard]] bool holds() const { return holds_; }

 private:
  struct Picture {
    TrackedHand hand;
    TimePoint at;
  };
  void look(TrackedMotion& motion);
  void run();
  void serve(TrackedMotion& motion);
  [[nodiscard]] bool is_wanted(TrackedMotion& motion);

  const std::string kiosk_;
  const std::uint32_t domain_;
  realtime::Mailbox<Picture> pictures_;
  realtime::Wakeup wakeup_;
  std::atomic<bool> stop_{false}, holds_{false};
  std::atomic<pointer::PointerLinkState> state_{pointer::PointerLinkState::none};
  std::thread thread_;  ///< declared last
};

/// Both hands, by side. On the loop's thread.
class TrackedHands {
 public:
  using Make = std::function<std::unique_ptr<TrackedLink>()>;
  using End = std::function<void(std::unique_ptr<TrackedLink>)>;
  /// `end`: for somebody who may wait for a link's thread.
  TrackedHands(Make make, End end) : make_(std::move(make)), end_(std::move(end)) {}
  ~TrackedHands() { release(); }
  TrackedHands(const TrackedHands&) = delete;
  TrackedHands& operator=(const TrackedHands&) = delete;

  /// A link is made for a hand that is tracked. Without any hand: the headset was taken off.
  void take(std::span<const TrackedHand> hands);
  /// The server lets go of what they hold.
  void release();
  /// What the headset's panel shows: STREAM.md, `tracked`. Empty: no hand was ever seen.
  [[nodiscard]] std::string text() const;

 private:
  Make make_;
  End end_;
  std::array<std::unique_ptr<TrackedLink>, 2> links_;
  bool used_ = false;
};

}  // namespace mechane::gateway
