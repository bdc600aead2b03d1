// Styluses in one world of a server, each over a network of its own: the clients' whole loops, and the server's whole tick, on a
// simulated clock.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/slow_network.hpp"

namespace mechane::test {

/// A stylus in a relaxed hand, with its client.
class PlayedStylus {
 public:
  PlayedStylus(haptic::RenderMode mode, const Network& network, unsigned seed, const Vec3& p_WH)
      : network_(client_, network, seed), stylus_({.hand = haptic::ArmConfig{}}, p_WH) {
    loop_ = std::move(haptic::HapticLoop::create(client_, stylus_, mode, network.deadband).value());
  }

  /// A millisecond of the client, in which the hand wants this.
  void tick(const haptic::HandIntent& intent, TimePoint now) {
    network_.deliver(now);
    stylus_.intend(intent);
    const Vec3 force_W = stylus_.force_W();
    const Vec3 before = stylus_.p_WH();
    loop_->tick(now, kTickPeriod);
    energy_j_ += force_W.dot(stylus_.p_WH() - before);
    energy_max_j_ = std::max(energy_max_j_, energy_j_);
  }
  /// What the server has of this hand.
  state::UserInput input(TimePoint now) {
    state::UserInput input;
    input.present = true;
    input.fresh = std::exchange(heard_, client_.sent_sequence()) != client_.sent_sequence();
    if (input.fresh) heard_at_ = now;
    input.age = now - heard_at_;
    input.sample = {client_.hand, client_.session(), client_.sent_sequence(), 0};
    return input;
  }
  void answer(const hand::HapticOutput& output, TimePoint now) { network_.send(output, now); }

  [[nodiscard]] const Vec3& p_WH() const { return stylus_.p_WH(); }
  [[nodiscard]] Vec3 force_W() const { return loop_->rendered().force_W.f; }
  [[nodiscard]] const haptic::LoopStats& stats() const { return loop_->stats(); }
  [[nodiscard]] const SlowNetwork& network() const { return network_; }
  /// What the hand was given beyond what it had put in, J: now, and the most that it ever was.
  [[nodiscard]] double energy_j() const { return energy_j_; }
  [[nodiscard]] double energy_max_j() const { return energy_max_j_; }

 private:
  ScriptedClient client_;
  SlowNetwork network_;
  haptic::SimulatedStylus stylus_;
  std::unique_ptr<haptic::HapticLoop> loop_;
  std::uint64_t heard_ = 0;  // by the world: the newest sample, and when it came
  TimePoint heard_at_;
  double energy_j_ = 0;
  double energy_max_j_ = 0;
};

class PlayedWorld {
 public:
  /// A stylus begins at each of these places.
  PlayedWorld(std::shared_ptr<const state::WorldDescription> description, std::span<const Vec3> places_WH,
              haptic::RenderMode mode, const Network& network, unsigned seed = 1) {
    world::WorldConfig config;
    config.hand = shared_hand();
    world_ = std::move(world::World::create(std::move(description), config).value());
    for (const Vec3& p_WH : places_WH)
      hands_.push_back(std::make_unique<PlayedStylus>(mode, network, seed++, p_WH));
  }

  /// A millisecond, in which each hand wants this.
  void tick(std::span<const haptic::HandIntent> intents) {
    now_ += kTickPeriod;
    state::TickInputs inputs;
    for (std::size_t u = 0; u < hands_.size(); ++u) {
      hands_[u]->tick(intents[u], now_);
      inputs.users[u] = hands_[u]->input(now_);
    }
    world::step(*world_, inputs, publisher_, timer_);
    for (std::size_t u = 0; u < hands_.size(); ++u)
      hands_[u]->answer(world_->state.users[u].output, now_);
  }

  [[nodiscard]] state::WorldState& state() { return world_->state; }
  [[nodiscard]] const state::WorldState& state() const { return world_->state; }
  [[nodiscard]] const PlayedStylus& hand(std::size_t u) const { return *hands_[u]; }

 private:
  std::unique_ptr<world::World> world_;
  std::vector<std::unique_ptr<PlayedStylus>> hands_;
  SystemClock clock_;
  world::PhaseTimer timer_{clock_};
  world::NoPublisher publisher_;
  TimePoint now_{std::chrono::hours(1)};
};

}  // namespace mechane::test
