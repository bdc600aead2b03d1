// What a crane's lift costs the hand, measured from outside: the hand's wrench on the crank, how far the load rises, what rope is wound.
#pragma once

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/exhibit_play.hpp"

namespace mechane::test {

inline constexpr double kGravity = 9.81;

/// Both cranes alike: of their drum, their crank and their sheaves.
struct CraneFigures {
  static constexpr double load_n = 60 * kGravity;
  static constexpr double drum_radius_m = 0.06;
  static constexpr double crank_radius_m = 0.30;
  static constexpr double sheave_efficiency = 0.9;
  static constexpr double bearing_nm = 1.0;
  static constexpr double viscous_nm_s = 0.2;
};

/// While the crank goes from half a turn to one and a half: means and sums in real units.
struct CraneLift {
  std::size_t ticks = 0;
  double handle_n = 0;   ///< the hand's torque about the axle over the crank's radius
  double tension_n = 0;  ///< of the rope at the drum
  double work_j = 0;     ///< of the hand on the drum
  double rate = 0;       ///< rad/s of the drum
  double turned_rad = 0;
  double wound_m = 0;
  double risen_m = 0;
  PlayedVisit visit;
};

/// Plays `lifting` and measures. `change` as in PlayOptions.
inline CraneLift measure_lift(const Exhibit& crane, std::function<void(state::WorldDescription&)> change = {}) {
  const state::WorldDescription& world = crane.description();
  const JointId axle = world.find_joint("AXLE");
  const BodyId drum = world.find_body("DRUM"), load = world.find_body("LOAD");
  const Vec3 p_WA = world.bodies[drum.index()].X_WB.p;
  const auto quantity = [&](const char* name) { return world.find_quantity(name).index(); };
  const std::size_t tension = quantity("tension"), rope = quantity("rope");
  CraneLift lift;
  double height_m = 0, rope_m = 0, first_rad = 0, last_rad = 0;
  PlayOptions options;
  options.change = std::move(change);
  options.watch = [&](const state::WorldState& state) {
    const state::JointState& joint = state[axle];
    const state::Grasp& grasp = state.users[0].grasp;
    if (!grasp.active || grasp.body != drum || joint.position < kPi || joint.position > 3 * kPi) return;
    const Vec3 p_AG_W = state[drum].X_WB * grasp.p_BG - p_WA;
    const double felt_nm = -(p_AG_W.cross(grasp.reaction_W.f) + grasp.reaction_W.t).z();
    const double real_nm = felt_nm / world.effort_scale;
    if (lift.ticks++ == 0) {
      height_m = state[load].X_WB.p.y();
      rope_m = state.quantities[rope];
      first_rad = joint.position;
    }
    lift.handle_n += real_nm / CraneFigures::crank_radius_m;
    lift.tension_n += state.quantities[tension];
    lift.work_j += real_nm * joint.velocity * kTickSeconds;
    lift.rate += joint.velocity;
    lift.risen_m = state[load].X_WB.p.y() - height_m;
    lift.wound_m = rope_m - state.quantities[rope];
    last_rad = joint.position;
  };
  PlayedVisit visit = crane.play("lifting", options);
  const double n = static_cast<double>(std::max<std::size_t>(lift.ticks, 1));
  lift.handle_n /= n;
  lift.tension_n /= n;
  lift.rate /= n;
  lift.turned_rad = last_rad - first_rad;
  lift.visit = std::move(visit);
  return lift;
}

/// What the hand must do, by the law of the winch: tension times drum over crank, and the bearings' friction.
inline double handle_force_n(double tension_n, double rate_rad_per_s) {
  using F = CraneFigures;
  return (tension_n * F::drum_radius_m + F::bearing_nm + F::viscous_nm_s * rate_rad_per_s) / F::crank_radius_m;
}

/// The rope's end slips off the drum: it is fastened to the crane's frame instead, and no winding moves it.
inline void take_rope_off_drum(state::WorldDescription& world) {
  for (state::ComponentDescription& agent : world.agents) {
    if (agent.name != "ROPE") continue;
    const auto put_first = [&](const char* name, auto values) {
      auto& list = std::get<decltype(values)>(agent.parameters.at(name));
      list.insert(list.begin(), values.begin(), values.end());
    };
    put_first("bodies", std::vector<std::string>{"FRAME"});
    put_first("points", std::vector<double>{0.30, 0.80, 0});
    put_first("radii", std::vector<double>{0});
    put_first("senses", std::vector<double>{1});
    agent.parameters.erase("drum");
    agent.parameters.erase("drumRadius");
    return;
  }
  throw std::runtime_error(world.id + " has no rope");
}

}  // namespace mechane::test
