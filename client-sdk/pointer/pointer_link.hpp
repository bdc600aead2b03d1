// The hand that a display sends while somebody touches its picture: a session of its own at the kiosk, on a thread of its own, so that a slow
// picture does not make a slow hand.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client-sdk/pointer/pointer_hand.hpp"
#include <mechane/client/client.hpp>

namespace mechane::pointer {

/// How the hand stands with the server.
enum class PointerLinkState : std::uint8_t {
  none,     ///< nobody touched for a while: no session
  waiting,  ///< for the server
  joined,
  refused,  ///< every hand of the kiosk has an owner
};

/// A hand that a pointer moves.
class PointerTouch {
 public:
  virtual ~PointerTouch() = default;
  virtual void press(const picture::Sight& sight, picture::PixelPlace place, const picture::Touched& touched) = 0;
  virtual void move(picture::PixelPlace place) = 0;
  virtual void deepen(double notches) = 0;
  virtual void turn(double angle_rad) = 0;
  virtual void release() = 0;
  [[nodiscard]] virtual PointerView view() const = 0;
  [[nodiscard]] virtual PointerLinkState state() const = 0;
};

/// The session opens with the first press and ends when nobody has touched for half a minute, so that a picture that is only looked at
/// takes no hand of the world. It takes the kiosk's last free hand: devices count from the first. Between touches nothing is sent.
/// The functions are one thread's, the display's; none of them waits for the network.
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

  [[nodiscard]] PointerView view() const override;
  [[nodiscard]] PointerLinkState state() const override;

 private:
  using Lock = std::unique_lock<std::mutex>;
  struct Sensed;
  void run();
  /// One touch after another, until nobody has touched for long.
  void serve(client::Client& client);
  void look(client::Client& client, Sensed& sensed) const;
  [[nodiscard]] std::unique_ptr<client::Client> open();
  [[nodiscard]] bool resting() const;

  const std::string kiosk_;
  const std::uint32_t domain_;
  mutable std::mutex mutex_;  // for what follows
  std::condition_variable wanted_;
  bool stop_ = false;
  PointerHand hand_;
  PointerLinkState state_ = PointerLinkState::none;
  std::thread thread_;  // last
};

}  // namespace mechane::pointer
