// What ties joints and bodies beyond the joints themselves: gears, ratchets, ropes. Plain data: an agent sets it, dynamics solve it
// and write back the forces on it.
#pragma once

#include <array>
#include <cstdint>

#include "server/base/ids.hpp"
#include "server/base/math.hpp"
#include "server/state/limits.hpp"

namespace mechane::state {

enum class CouplingKind : std::uint8_t {
  fixed,         ///< body2 keeps its pose X_B1B2 against body1
  gear,          ///< joint2 goes `ratio` times as far as joint1: ratio * q1 - q2 = offset
  intermittent,  ///< joint2 goes one `step` while joint1 passes its window, once a turn: F(q1) - q2 = offset
  stop,          ///< joint1 does not go back beyond `offset`: sign * (q1 - offset) >= 0
  rope,          ///< the way over the nodes is at most `offset` long
  watch,         ///< ties nothing: measures what joint1 bears
};

/// Where a rope is fastened, or a sheave that it runs over.
struct RopeNode {
  BodyId body;                  ///< none: the world
  Vec3 p_BC = Vec3::Zero();     ///< the point, or the sheave's centre
  Vec3 axis_B = Vec3::UnitZ();  ///< of the sheave, unit length
  double radius_m = 0;          ///< 0: the rope runs through a point
  double sense = 1;  ///< +1: from first node to last the rope goes round the axis by the right hand; -1: the other way
  double efficiency = 1;            ///< tension of the leaving rope over that of the pulling one, when it moves
  double friction_coefficient = 0;  ///< Capstan: efficiency exp(-friction * wrap), times the one above
};

struct Coupling {
  // What it is; set when the world is made.
  CouplingKind kind = CouplingKind::watch;
  BodyId body1;  ///< fixed: without one, the world. rope with a drum: the body that bears the drum
  BodyId body2;
  JointId joint1;
  JointId joint2;
  double ratio = 1;   ///< gear: rad or m of joint2 for one rad or m of joint1
  double loss = 0;    ///< gear: friction on joint1 as a share of the tooth force on it; 1 and more: joint2 cannot drive
  double step = 0;    ///< intermittent: rad of joint2 a turn of joint1
  double window = 0;  ///< intermittent: rad of joint1 in which it drives
  double phase = 0;   ///< intermittent: rad of joint1 in the window's middle
  bool lock =
      true;  ///< intermittent: joint2 is held outside of the window; else it is taken along from wherever it stands
  double sign = 1;  ///< stop
  std::array<RopeNode, kMaxRopeNodes> nodes{};
  std::uint32_t node_count = 0;
  bool drum = false;         ///< the first node is a drum that turns with joint1
  double diameter_m = 0.02;  ///< rope: as it is drawn
  Vec3 drum_start_1 =
      Vec3::UnitX();  ///< from the drum's centre to where the rope leaves it at the start, in body1, unit length

  // What holds now; set by the agent in each tick.
  bool enabled = false;
  double offset = 0;  ///< see the kinds
  Pose X_B1B2;        ///< fixed

  // What dynamics found in the last step; zero while off.
  double force_n =
      0;  ///< fixed, watch: size of the force. gear, stop on a slider: the force. rope: tension of the first part
  double torque_nm = 0;    ///< fixed, watch: at body2's origin, at the joint. gear: on joint2. stop: on joint1
  double end_force_n = 0;  ///< rope: tension of the last part
  double length_m = 0;     ///< rope: what is off the drum
  double slack_m = 0;      ///< rope: how much longer it is than its way; 0: taut

  void forget_forces() noexcept { force_n = torque_nm = end_force_n = 0; }
};

/// How far joint2 of an intermittent gear stands, less its offset, where joint1 is at q1: a stair with a ramp in each window.
[[nodiscard]] double intermittent_position(const Coupling& gear, double q1) noexcept;

/// The way of a rope.
struct RopePath {
  std::array<Vec3, kMaxRopeNodes> p_in_W{};      ///< where it comes to each node; of the first: as p_out
  std::array<Vec3, kMaxRopeNodes> p_out_W{};     ///< where it leaves it
  std::array<double, kMaxRopeNodes> wrap_rad{};  ///< how far round each sheave; for a point, how far it is turned
  double length_m = 0;                           ///< from first node to last, along straight parts and sheaves
  double drum_angle_rad =
      0;  ///< how far the place where it leaves the drum has moved round the axis since the start, -pi to pi
};

/// `X_WN` are the poses of the nodes' bodies, `R_W1` the attitude of the body that bears the drum. The rope leaves sheaves along
/// tangents in the sheave's own plane; where a neighbour lies within the radius, at the nearest point. Allocates nothing.
[[nodiscard]] RopePath measure_rope(const Coupling& rope, const std::array<Pose, kMaxRopeNodes>& X_WN,
                                    const Quat& R_W1) noexcept;

}  // namespace mechane::state
