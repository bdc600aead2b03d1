// A stylus that holds the handle of a crank (crank_world.hpp): a client's whole loop, a network, and a server's whole world behind it.
#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

#include "client-sdk/haptic/haptic_loop.hpp"
#include "client-sdk/haptic/simulated_stylus.hpp"
#include "server/world/step.hpp"
#include "tests/support/crank_world.hpp"
#include "tests/support/slow_network.hpp"

namespace mechane::test {

class HeldCrank {
 public:
  /// Grasps the handle. Throws where it is not held after a second.
  HeldCrank(haptic::RenderMode mode, const Network& network, unsigned seed = 1) : network_(client_, network, seed) {
    world::WorldConfig config;
    config.hand = shared_hand();
    world_ = std::move(world::World::create(make_crank_description(), config).value());
    loop_ = std::move(haptic::HapticLoop::create(client_, stylus_, mode, network.deadband).value());
    stay(std::chrono::seconds(1));
    if (!world_->state.users[0].grasp.active) throw std::runtime_error("the stylus did not grasp the handle");
  }

  /// A millisecond in which the hand wants to be at `p_WH`.
  void tick(const Vec3& p_WH) {
    now_ += kTickPeriod;
    network_.deliver(now_);
    haptic::HandIntent intent;
    intent.X_WH.p = p_WH;
    intent.grasp_intent = 1;
    stylus_.intend(intent);
    const Vec3 force_W = stylus_.force_W();
    const Vec3 before = stylus_.p_WH();
    loop_->tick(now_, kTickPeriod);
    energy_j_ += force_W.dot(stylus_.p_WH() - before);
    energy_max_j_ = std::max(energy_max_j_, energy_j_);
    step_world();
  }
  /// The hand goes by `step_W` at 0.1 m/s, and stays there.
  void go(const Vec3& step_W, Duration time) {
    const Vec3 from = aim_;
    const double way_m = step_W.norm();
    for (Duration past{0}; past < time; past += kTickPeriod) {
      aim_ = from + step_W * std::min(1.0, way_m > 0 ? 0.1 * to_seconds(past) / way_m : 1.0);
      tick(aim_);
    }
    aim_ = from + step_W;
  }
  void stay(Duration time) { go(Vec3::Zero(), time); }

  [[nodiscard]] state::WorldState& state() { return world_->state; }
  [[nodiscard]] double turned_rad() const { return world_->state.joints[0].position; }
  [[nodiscard]] const Vec3& p_WH() const { return stylus_.p_WH(); }
  [[nodiscard]] Vec3 force_W() const { return loop_->rendered().force_W.f; }
  [[nodiscard]] const haptic::LoopStats& stats() const { return loop_->stats(); }
  [[nodiscard]] const SlowNetwork& network() const { return network_; }
  /// The most that the hand was ever given beyond what it had put in, J.
  [[nodiscard]] double energy_max_j() const { return energy_max_j_; }

  /// Pulls the handle outwards, across its circle, by a hand that goes 8 mm. Returns the stiffness that it feels, N/m.
  double stiffness_across() {
    const Vec3 before = p_WH();
    go(Vec3(0.008, 0, 0), std::chrono::seconds(2));
    const double stiffness = -force_W().x() / (p_WH().x() - before.x());
    go(Vec3(-0.008, 0, 0), std::chrono::seconds(1));
    return stiffness;
  }

  /// Where the hand began.
  static Vec3 start() { return {kCrankRadiusM + kGripRadiusM + 0.004, 0, 0}; }

 private:
  void step_world() {
    state::TickInputs inputs;
    inputs.users[0].present = true;
    inputs.users[0].fresh = std::exchange(heard_, client_.sent_sequence()) != client_.sent_sequence();
    if (inputs.users[0].fresh) heard_at_ = now_;
    inputs.users[0].age = now_ - heard_at_;
    inputs.users[0].sample = {client_.hand, client_.session(), client_.sent_sequence(), 0};
    world::step(*world_, inputs, publisher_, timer_);
    network_.send(world_->state.users[0].output, now_);
  }

  ScriptedClient client_;
  SlowNetwork network_;
  std::unique_ptr<world::World> world_;
  haptic::SimulatedStylus stylus_{{.hand = haptic::ArmConfig{}}, start()};
  std::unique_ptr<haptic::HapticLoop> loop_;
  SystemClock clock_;
  world::PhaseTimer timer_{clock_};
  world::NoPublisher publisher_;
  TimePoint now_{std::chrono::hours(1)};
  std::uint64_t heard_ = 0;  // by the world: the newest sample, and when it came
  TimePoint heard_at_;
  Vec3 aim_ = start();
  double energy_j_ = 0;
  double energy_max_j_ = 0;
};

}  // namespace mechane::test
