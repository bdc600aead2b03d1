// What lies between a client and its server: a server's answers on their way to a ScriptedClient, on a simulated clock.
#pragma once

#include <map>
#include <random>

#include "tests/support/scripted_client.hpp"

namespace mechane::test {

/// There and back together.
struct Network {
  int delay_ms = 0;
  int jitter_ms = 0;  ///< on top, evenly
  double loss = 0;
};

class SlowNetwork {
 public:
  SlowNetwork(ScriptedClient& client, const Network& network, unsigned seed)
      : client_(client), network_(network), random_(seed) {}

  /// What the server says at `now` of the last sample that was sent.
  void send(const hand::HapticOutput& output, TimePoint now) {
    const client::ForceSample answer = client_.answer_with(output, now);
    client_.arrived.reset();
    if (std::uniform_real_distribution<>()(random_) < network_.loss) return;
    const int late_ms = network_.delay_ms + std::uniform_int_distribution<>(0, network_.jitter_ms)(random_);
    on_the_way_.emplace(now + std::chrono::milliseconds(late_ms), answer);
  }
  /// The newest of those that have come.
  void deliver(TimePoint now) {
    while (!on_the_way_.empty() && on_the_way_.begin()->first <= now) {
      client::ForceSample& answer = on_the_way_.begin()->second;
      if (!client_.arrived || answer.sequence > client_.arrived->sequence) client_.arrived = answer;
      client_.arrived->received = now;
      on_the_way_.erase(on_the_way_.begin());
    }
  }

 private:
  ScriptedClient& client_;
  Network network_;
  std::mt19937 random_;
  std::multimap<TimePoint, client::ForceSample> on_the_way_;
};

}  // namespace mechane::test
