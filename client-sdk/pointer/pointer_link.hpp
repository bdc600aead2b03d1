// A hand that a display sends while somebody touches its picture: a session of its own at the kiosk, on a thread of
// its own, so that slow drawing does not slow down the hand.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "client-sdk/pointer/pointer_exchange.hpp"
#include "client-sdk/pointer/pointer_fingers.hpp"
#include <mechane/client/client.hpp>

namespace mechane::pointer {

/// A hand that a pointer moves.
class PointerTouch {
 public:
  virtual ~PointerTouch() = default;
  virtual void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) = 0;
  virtual void move(picture::PixelPlace place) = 0;
  virtual void deepen(double notches) = 0;
  virtual void turn(double angle_rad) = 0;
  virtual void release() = 0;
  [[nodiscard]] virtual PointerView view() = 0;
  [[nodiscard]] virtual PointerLinkState state() = 0;
};

/// What fingers must know of the hand that they move.
[[nodiscard]] HandState state_of(const PointerView& view, picture::PixelSize picture);
/// Does what fingers ask of a hand, except `take`: only the caller knows what there is to take. The place of a `move` is
/// in the eye's picture.
void fulfil(const HandRequest& request, PointerTouch& hand);

/// The session opens with the first press and ends half a minute after the last touch, so that a display that is only
/// watched occupies no hand of the world. It takes the kiosk's last free hand; devices take the first ones. Between
/// touches nothing is sent. All functions are called on the display's thread; none waits for the network or for the
/// hand's thread.
class PointerLink final : public PointerTouch {
 public:
  PointerLink(std::string kiosk, std::uint32_t domain);
  PointerLink(const PointerLink&) = delete;
  PointerLink& operator=(const PointerLink&) = delete;
  ~PointerLink() override;

  void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) override;
  void move(picture::PixelPlace place) override;
  void deepen(double notches) override;
  void turn(double angle_rad) override;
  void release() override;

  [[nodiscard]] PointerView view() override { return exchange_.view(); }
  [[nodiscard]] PointerLinkState state() override { return exchange_.state(); }

 private:
  struct Sensed;
  void run();
  /// Serves one touch after another, until nobody has touched for long.
  void serve(client::Client& client);
  void look(client::Client& client, Sensed& sensed) const;
  [[nodiscard]] std::unique_ptr<client::Client> open();
  /// False: nobody touched, or the link is ending.
  [[nodiscard]] bool wait_for_touch(Duration longest);
  void show(PointerLinkState state);

  const std::string kiosk_;
  const std::uint32_t domain_;
  PointerExchange exchange_;
  std::atomic<bool> stop_{false};
  PointerLinkState state_ = PointerLinkState::none;  ///< used by the hand's thread only
  std::thread thread_;                               ///< declared last
};

}  // namespace mechane::pointer
