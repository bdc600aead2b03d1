// What hubs and browsers use of the gateway.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "client-sdk/gateway/browsers/hand_finders.hpp"
#include "client-sdk/gateway/browsers/known_content.hpp"
#include "client-sdk/gateway/sign_in/kiosk_tokens.hpp"
#include "server/base/clock.hpp"
#include "server/base/worker.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::gateway {

struct Backstage {
  std::uint32_t domain = 0;
  Worker& slow;                                     ///< opens and ends what talks on the network: both can take a while
  std::function<void(std::function<void()>)> post;  ///< runs a job on the loop's thread
  std::shared_ptr<client::DisplaySeats> seats;
  KnownContent& content;
  KioskTokens& tokens;
  HandFinders finders{};

  /// Ends something on the slow thread, before the seats' maker. Of what is shared: this owner's part.
  template <class Thing>
  void end_slowly(std::shared_ptr<Thing> thing) const {
    if (thing) slow.give([shared = std::move(thing), maker = seats]() mutable { shared.reset(); });
  }
  template <class Thing>
  void end_slowly(std::unique_ptr<Thing> thing) const {
    end_slowly(std::shared_ptr<Thing>(std::move(thing)));
  }
};

/// This moment, as the loop's thread counts time.
[[nodiscard]] inline TimePoint time_now() {
  return std::chrono::steady_clock::now();
}

}  // namespace mechane::gateway
