// A hand of a kiosk that nobody has yet, for a program that moves it now and then.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <mechane/client/client.hpp>

namespace mechane::pointer {

inline constexpr int kHandFifoPriority = 60;  ///< lower than the devices' loops

/// Joins the kiosk as its last free hand; devices take the first ones. Every 20 ms it asks `goes_on` whether the hand is still
/// wanted; where not, it returns a client that has not joined yet. Null: all hands are in use, or there is no network, which is
/// logged. `program`: for logs.
[[nodiscard]] std::unique_ptr<client::Client> take_last_hand(const std::string& kiosk, std::uint32_t domain,
                                                             const std::string& program,
                                                             const std::function<bool()>& goes_on);

/// Raises this thread's priority while it exists, so that drawing on the processor does not delay it: a hand that is
/// silent for 50 ms lets go. Without permission nothing changes. Threads that the network library starts before or
/// after stay ordinary.
class Hurry {
 public:
  Hurry();
  Hurry(const Hurry&) = delete;
  Hurry& operator=(const Hurry&) = delete;
  ~Hurry();
};

}  // namespace mechane::pointer
