#include "client-sdk/pointer/free_hand.hpp"

#include <array>
#include <chrono>

#include <pthread.h>

#include "server/log/log.hpp"
#include "server/realtime/priority.hpp"

namespace mechane::pointer {
namespace {

constexpr std::array<std::uint32_t, 3> kUsers{3, 2, 1};

}  // namespace

Hurry::Hurry() {
  (void)realtime::take_fifo(kHandFifoPriority);
}

Hurry::~Hurry() {
  const sched_param ordinary{0};
  (void)pthread_setschedparam(pthread_self(), SCHED_OTHER, &ordinary);
}

std::unique_ptr<client::Client> take_last_hand(const std::string& kiosk, std::uint32_t domain,
                                               const std::string& program, const std::function<bool()>& goes_on) {
  for (const std::uint32_t user : kUsers) {
    client::ClientConfig config;
    config.kiosk = kiosk;
    config.user = user;
    config.role = client::Role::hand;
    config.program = program;
    config.domain = domain;
    config.fifo_priority = kHandFifoPriority;
    auto client = client::Client::connect(config);
    if (!client) {
      log::error(client.error());
      return nullptr;
    }
    const auto look_again = std::chrono::milliseconds(20);
    while ((*client)->state() != client::LinkState::refused)
      if ((*client)->wait_for(client::LinkState::joined, look_again) || !goes_on()) return std::move(*client);
  }
  return nullptr;
}

}  // namespace mechane::pointer
