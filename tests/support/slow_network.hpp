// What lies between a client and its server: a server's answers on their way to a ScriptedClient, on a simulated clock.
#pragma once

#include <map>
#include <random>
#include <utility>

#include "server/hand/deadband.hpp"
#include "tests/support/scripted_client.hpp"

namespace mechane::test {

/// There and back together.
struct Network {
  int delay_ms = 0;
  int jitter_ms = 0;  ///< on top, evenly
  double loss = 0;
  double deadband = 0;  ///< the share by which both sides leave messages out
};

class SlowNetwork {
 public:
  SlowNetwork(ScriptedClient& client, const Network& network, unsigned seed)
      : client_(client), network_(network), random_(seed) {}

  /// What the server says at `now` of the last sample that was sent.
  void send(const hand::HapticOutput& output, TimePoint now) {
    client::ForceSample answer = client_.answer_with(output, now);
    client_.arrived.reset();
    if (std::exchange(echo_, answer.echo_sequence) != answer.echo_sequence) taken_at_ = now;
    answer.waited = now - taken_at_;
    if (!deadband_.is_due(network_.deadband, answer, client_.hand.X_WH.p, now)) return;
    deadband_.note_sent(answer, client_.hand.X_WH.p, now);
    ++sent_;
    if (std::uniform_real_distribution<>()(random_) < network_.loss) return;
    const int late_ms = network_.delay_ms + std::uniform_int_distribution<>(0, network_.jitter_ms)(random_);
    on_the_way_.emplace(now + std::chrono::milliseconds(late_ms), answer);
  }
  /// How many answers went out, lost ones too.
  [[nodiscard]] std::uint64_t sent() const { return sent_; }
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
  hand::OutputDeadband deadband_;
  std::uint64_t sent_ = 0;
  std::uint64_t echo_ = 0;  // of the newest sample that the server has
  TimePoint taken_at_;
  std::multimap<TimePoint, client::ForceSample> on_the_way_;
};

}  // namespace mechane::test
