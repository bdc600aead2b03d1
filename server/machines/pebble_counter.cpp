// machine.pebble_counter: the last drum of Vitruvius' odometer (De architectura X.9), which drops a pebble for each mile.
//
// The drum has holes at equal angles, a pebble in each, and turns over a floor with one opening. As a hole comes over the opening, its
// pebble falls into the bronze vessel, and the hole stays empty. So the drum counts forwards only: turned back and on again, it brings
// empty holes. By default the opening lies half way between two holes at rest, so that a drum moved by jerks of a tooth drops its
// pebble in the middle of a jerk. The distance is pebbles * distancePerPebble. What a pebble stands for depends on the wheel and the
// gears before this drum; the author states it, to scale or shortened.
//
// The bodies in 'stones' are the pebbles: each is held still in its hole until its turn comes, then it is let go and falls.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/machine.hpp"

namespace mechane::machines {
namespace {

struct PebbleCounterSettings {
  JointId joint;
  double direction = 1;
  double first_rad = 0;
  double step_rad = 0;
  double holes = 1;
  double distance_m = 0;
};

/// A pebble and where it lies in the drum.
struct Pebble {
  BodyId body;
  Pose X_DP;
};

class PebbleCounter final : public Machine {
 public:
  PebbleCounter(const Build& build, const PebbleCounterSettings& settings, std::vector<Pebble> pebbles)
      : s_(settings),
        drum_(build.description.joints[settings.joint.index()].body2),
        stones_(std::move(pebbles)),
        pebbles_(build.slot("pebbles")),
        distance_m_(build.slot("distance_m")),
        left_(build.slot("left", settings.holes)) {}

  void run(state::WorldState& state, double /*dt_s*/) const noexcept override {
    const state::JointState& joint = state[s_.joint];
    double& fallen = state.memory[pebbles_];
    if (joint.enabled) {
      const double passed = std::floor((s_.direction * joint.position - s_.first_rad) / s_.step_rad + 1);
      const double falls = std::clamp(passed, fallen, s_.holes);
      for (auto i = static_cast<std::size_t>(fallen); i < static_cast<std::size_t>(falls) && i < stones_.size(); ++i)
        state[stones_[i].body].movable = true;
      fallen = falls;
    }
    state.memory[distance_m_] = fallen * s_.distance_m;
    state.memory[left_] = s_.holes - fallen;
    carry(state, static_cast<std::size_t>(fallen));
  }

 private:
  /// Moves the stones that have not fallen with the drum.
  void carry(state::WorldState& state, std::size_t from) const noexcept {
    const Pose& X_WD = state[drum_].X_WB;
    for (std::size_t i = from; i < stones_.size(); ++i) {
      state::BodyState& stone = state[stones_[i].body];
      stone.movable = false;
      stone.X_WB = X_WD * stones_[i].X_DP;
      stone.V_WB = {};
    }
  }

  PebbleCounterSettings s_;
  BodyId drum_;
  std::vector<Pebble> stones_;  // in the order in which they fall
  std::size_t pebbles_;
  std::size_t distance_m_;
  std::size_t left_;
};

Expected<std::vector<Pebble>> read_pebbles(const Build& build, double holes) {
  std::vector<Pebble> pebbles;
  const std::vector<std::string> names = build.parameters.texts("stones");
  if (static_cast<double>(names.size()) > holes)
    return fail(ErrorCode::conflict, fmt::format("there are {} stones for {} holes", names.size(), holes),
                build.place("stones"), "name fewer stones, or give the drum more holes");
  const state::JointDescription& joint = build.description.joints[build.parameters.joint("joint").index()];
  const Pose X_DW = build.description.bodies[joint.body2.index()].X_WB.inverse();
  for (const std::string& name : names) {
    const BodyId body = build.description.find_body(name);
    const state::BodyDescription& stone = build.description.bodies[body.index()];
    if (stone.fixed)
      return fail(ErrorCode::conflict, "the stone '" + name + "' is fixed", build.place("stones"),
                  "name bodies that can fall");
    pebbles.push_back({body, X_DW * stone.X_WB});
  }
  return pebbles;
}

Expected<std::unique_ptr<Machine>> make_pebble_counter(const Build& build) {
  const state::Parameters& p = build.parameters;
  PebbleCounterSettings s;
  const auto joint = build.joint("joint", state::JointKind::hinge);
  if (!joint) return tl::unexpected(joint.error());
  s.joint = *joint;
  const auto holes = build.whole_number("holes");
  if (!holes) return tl::unexpected(holes.error());
  s.holes = *holes;
  s.direction = p.boolean("reversed") ? -1 : 1;
  s.step_rad = 2 * kPi / s.holes;
  s.first_rad = p.given("firstHole") ? p.number("firstHole") : s.step_rad / 2;
  s.distance_m = p.number("distancePerPebble");
  auto pebbles = read_pebbles(build, s.holes);
  if (!pebbles) return tl::unexpected(pebbles.error());
  return std::make_unique<PebbleCounter>(build, s, std::move(*pebbles));
}

using state::ParameterKind;
constexpr state::ParameterType kPebbleCounterParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge of the drum with the pebbles; its second body is the drum",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "holes", .summary = "of the drum, each with a pebble", .required = true, .min = 1, .max = 1000},
    {.name = "distancePerPebble",
     .unit = "m",
     .summary = "the way of the cart from one pebble to the next; a Roman mile is 1480 m",
     .required = true,
     .min = 0.01,
     .max = 1e5},
    {.name = "firstHole",
     .unit = "rad",
     .summary = "of the drum, when the first hole comes over the opening; not given: half of one hole's share",
     .min = 1e-3,
     .max = 100},
    {.name = "stones",
     .kind = ParameterKind::texts,
     .summary = "the pebbles, in the order in which they fall; none: they are only counted",
     .reference = state::Reference::body},
    {.name = "reversed",
     .kind = ParameterKind::boolean,
     .summary = "true: the drum counts when it turns to negative angles"},
};
constexpr state::ValueType kPebbleCounterValues[] = {
    state::amount("pebbles", "", "fallen so far", "holes"),
    state::amount("distance_m", "m", "that the pebbles stand for"),
    state::amount("left", "", "pebbles still in the drum", "holes"),
};

}  // namespace

const MachineKind& pebble_counter_kind() {
  static const MachineKind kKind{{"machine.pebble_counter", "Drops a pebble as each hole of a drum passes",
                                  kPebbleCounterParameters, kPebbleCounterValues},
                                 make_pebble_counter};
  return kKind;
}

}  // namespace mechane::machines
