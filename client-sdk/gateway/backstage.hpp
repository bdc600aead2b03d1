// What hubs and browsers use of the gateway.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "client-sdk/gateway/kiosk_tokens.hpp"
#include "client-sdk/gateway/known_content.hpp"
#include "server/base/worker.hpp"
#include <mechane/client/displays.hpp>

namespace mechane::gateway {

struct Backstage {
  std::uint32_t domain = 0;
  Worker& slow;                                     ///< opens and ends what talks on the network: both can take a while
  std::function<void(std::function<void()>)> post;  ///< runs a job on the loop's thread
  client::DisplaySeats& seats;
  KnownContent& content;
  KioskTokens& tokens;

  /// Ends something on the slow thread.
  template <class Thing>
  void end_slowly(std::unique_ptr<Thing> thing) const {
    if (thing) slow.give([shared = std::shared_ptr<Thing>(std::move(thing))]() mutable { shared.reset(); });
  }
};

}  // namespace mechane::gateway
