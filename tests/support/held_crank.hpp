// A stylus that holds the handle of a crank (crank_world.hpp): a client's whole loop, a network, and a server's whole world behind it.
#pragma once

#include <algorithm>
#include <stdexcept>

#include "tests/support/played_world.hpp"

namespace mechane::test {

/// The crank off its axle: of 2 kg, an eighth of which is felt, in its handle's middle.
inline std::shared_ptr<const state::WorldDescription> make_loose_crank() {
  auto world = make_crank_description();
  world->joints[0].enabled_at_start = false;
  world->agents.erase(world->agents.begin());  // the hinge's
  world->quantities[0] = world->quantities[1];
  world->bodies[1].use_gravity = true;
  world->bodies[1].effort_scale = 0.125;
  world->bodies[1].p_BCm = Vec3(kCrankRadiusM, 0, 0);
  return world;
}
inline constexpr double kLooseCrank_n = 2 * 0.125 * 9.81;

class HeldCrank {
 public:
  /// Grasps the handle. Throws where it is not held after a second.
  HeldCrank(haptic::RenderMode mode, const Network& network, unsigned seed = 1,
            std::shared_ptr<const state::WorldDescription> world = make_crank_description())
      : play_(std::move(world), std::span(&aim_, 1), mode, network, seed) {
    stay(std::chrono::seconds(1));
    if (!state().users[0].grasp.active) throw std::runtime_error("the stylus did not grasp the handle");
  }

  /// A millisecond in which the hand wants to be at `p_WH`.
  void tick(const Vec3& p_WH) {
    haptic::HandIntent intent;
    intent.X_WH.p = p_WH;
    intent.grasp_intent = 1;
    play_.tick(std::span(&intent, 1));
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

  [[nodiscard]] state::WorldState& state() { return play_.state(); }
  [[nodiscard]] double turned_rad() const { return play_.state().joints[0].position; }
  [[nodiscard]] const Vec3& p_WH() const { return play_.hand(0).p_WH(); }
  [[nodiscard]] Vec3 force_W() const { return play_.hand(0).force_W(); }
  [[nodiscard]] const haptic::LoopStats& stats() const { return play_.hand(0).stats(); }
  [[nodiscard]] const SlowNetwork& network() const { return play_.hand(0).network(); }
  /// The most that the hand was ever given beyond what it had put in, J.
  [[nodiscard]] double energy_max_j() const { return play_.hand(0).energy_max_j(); }

  /// Pulls the handle outwards, across its circle, by a hand that goes 8 mm. Returns the stiffness that it feels, N/m.
  double stiffness_across() {
    const Vec3 before = p_WH();
    go(Vec3(0.008, 0, 0), std::chrono::seconds(2));
    const double stiffness = -force_W().x() / (p_WH().x() - before.x());
    go(Vec3(-0.008, 0, 0), std::chrono::seconds(1));
    return stiffness;
  }

  /// The share of the loose crank's weight that is felt, once it is held still.
  double weight_share() {
    stay(std::chrono::seconds(2));
    return -force_W().y() / kLooseCrank_n;
  }

  /// Where the hand began.
  static Vec3 start() { return {kCrankRadiusM + kGripRadiusM + 0.004, 0, 0}; }

 private:
  Vec3 aim_ = start();
  PlayedWorld play_;
};

}  // namespace mechane::test
