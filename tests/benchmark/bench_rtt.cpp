// Motion to force: a client sends a hand to a running server and waits for the force that answers it. The server answers in its next
// tick; how long the input waited for that tick comes back in the answer and is told apart.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>

#include <CLI/CLI.hpp>

#include "server/realtime/priority.hpp"
#include "tests/benchmark/bench_stats.hpp"
#include <mechane/client/client.hpp>
#include <mechane/proto/topics.hpp>

namespace mechane::benchmark {
namespace {

struct Config {
  int priority = 50;
  double seconds = 5;
  std::uint32_t domain = 0;
};

// A little over the tick's period, so that the samples arrive at every moment of a tick.
constexpr Duration kPeriod = std::chrono::microseconds(1003);
constexpr Duration kGiveUp = std::chrono::milliseconds(100);
constexpr std::uint64_t kWarmUp = 500;

struct Trips {
  explicit Trips(std::size_t room) : whole(room), waited(room), path(room), woken(room) {}
  Samples
      whole;  // from the sending of the hand to the arrival of the force in this process, where a device's loop takes it
  Samples waited;  // the share of it that the input waited for its tick
  Samples path;    // the rest: what the network, the threads and the tick itself take
  Samples woken;   // from that arrival until a thread that sleeps for it has it; no part of `whole`
  std::uint64_t lost = 0;
};

std::optional<client::ForceSample> answer_to(client::Client& client, std::uint64_t sequence, SystemClock& clock) {
  const TimePoint until = clock.now() + kGiveUp;
  while (clock.now() < until) {
    const auto force = client.wait_force(until - clock.now());
    if (force && force->echo_sequence >= sequence) return force;
  }
  return std::nullopt;
}

// A free hand, a metre above the ground, that moves a little: contacts would add what bench_tick tells.
client::HandSample hand_at(std::uint64_t number) {
  client::HandSample hand;
  hand.X_WH.p = Vec3(0, 1.8 + 0.01 * std::sin(0.006 * static_cast<double>(number)), 1.0);
  return hand;
}

void measure(client::Client& client, double seconds, Trips& trips) {
  SystemClock clock;
  const auto count = kWarmUp + static_cast<std::uint64_t>(seconds * 1000);
  TimePoint due = clock.now();
  for (std::uint64_t number = 0; number < count; ++number) {
    due = std::max(due + kPeriod, clock.now());
    clock.sleep_until(due);  // sleeps: the pace
    const TimePoint sent = clock.now();
    const bool went = client.send(hand_at(number));
    const auto force = went ? answer_to(client, client.sent_sequence(), clock) : std::nullopt;
    const TimePoint awake = clock.now();
    if (number < kWarmUp) continue;
    if (!force) {
      ++trips.lost;
      continue;
    }
    const Duration took = force->received - sent;
    trips.whole.add(took);
    trips.waited.add(force->waited);
    trips.path.add(took - force->waited);
    trips.woken.add(awake - force->received);
  }
}

int run(const Config& config) {
  Report report;
  if (!realtime::take_fifo(config.priority)) report.note("rtt: SCHED_FIFO was refused, ordinary priority");
  client::ClientConfig who;
  who.kiosk = "bench-rtt";
  who.role = client::Role::hand;
  who.program = "bench_rtt";
  who.domain = config.domain;
  auto client = client::Client::connect(who);
  if (!client || !(*client)->wait_for(client::LinkState::joined, std::chrono::seconds(30))) {
    std::cerr << "bench_rtt: "
              << (client ? "no server let the hand in within 30 s " + (*client)->refusal() : client.error().to_string())
              << "\n";
    return 1;
  }
  Trips trips(static_cast<std::size_t>(config.seconds * 1000));
  measure(**client, config.seconds, trips);
  if (trips.path.size() == 0) {
    std::cerr << "bench_rtt: no force came back\n";
    return 1;
  }
  report.distribution("rtt_us", trips.path);
  report.distribution("rtt_whole_us", trips.whole);
  report.distribution("rtt_wait_us", trips.waited);
  report.distribution("rtt_waiter_us", trips.woken);
  report.metric("rtt_lost", static_cast<double>(trips.lost));
  report.metric("bytes.input", static_cast<double>(sizeof(proto::HapticInput)));
  report.metric("bytes.output", static_cast<double>(sizeof(proto::HapticOutput)));
  report.note(
      "rtt_us is rtt_whole_us without rtt_wait_us, sample by sample: the input's wait for its tick; the hand is free. "
      "It ends "
      "when the force is in the client, where a device's own loop takes it; rtt_waiter_us is what a sleeper waits on "
      "top");
  std::cout << report.text() << "\n";
  return 0;
}

}  // namespace
}  // namespace mechane::benchmark

int main(int argc, char** argv) {
  mechane::benchmark::Config config;
  CLI::App app{"Round trip from a hand's motion to its force, through a running server"};
  app.add_option("--priority", config.priority, "SCHED_FIFO priority of this process; 0: none")
      ->check(CLI::Range(0, 99));
  app.add_option("--seconds", config.seconds, "how long")->check(CLI::Range(0.1, 3600.0));
  app.add_option("--domain", config.domain, "DDS domain")->check(CLI::Range(0, 230));
  CLI11_PARSE(app, argc, argv);
  return mechane::benchmark::run(config);
}
