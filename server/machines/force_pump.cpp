// machine.force_pump: Ktesibios' pump (Vitruvius X.7; Heron, Pneumatica I.28): one or two cylinders, a vessel, an upright pipe.
//
// Pistons. Their positions are those of slider joints, or a rocking beam's angle times `arm`, one up as the other goes down. How they
// draw and press is in pump_cylinder.hpp: the flow is area * stroke * efficiency for each falling stroke.
//
// Vessel. The water first fills the vessel and the pipe (`riser`), and the head grows with it up to `lift`. Then it leaves by the
// trumpet. Air under the cowl evens out the pulses: water above the brim runs out with the time constant `cushion`. That, and the
// second cylinder, make the jet continuous.
//
// Load. A falling piston carries rho g head area, and every piston has its leather's friction. Through the beam that is a torque;
// divided by the handle's arm it is the force at the hand. Times effort_scale it goes to the joints as a resistance, which holds but
// never drives, because the valves keep the water from pushing back. Below kTight_m_s the leather leaks: a piston lifts and carries
// less in proportion. That is this model's own, so that a piston turns round smoothly. The energy put in is force times way, and at
// least rho g lift times the volume lifted.
#include <algorithm>
#include <array>
#include <cmath>

#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"
#include "server/machines/pump_cylinder.hpp"

namespace mechane::machines {
namespace {

constexpr std::size_t kMostCylinders = 2;
constexpr double kTight_m_s = 0.02;
constexpr double kTurn = 0.25;  // share of the stroke after which a piston counts as turned round

struct ForcePumpSettings {
  std::array<JointId, kMostCylinders> pistons;  // sliders; none where a beam drives
  JointId beam;
  std::size_t cylinders = 2;
  std::array<PumpCylinder, kMostCylinders> cylinder;
  double direction = 1;
  double arm_m = 1;
  double handle_m = 1;
  double basin_m2 = 0;
  double bottom_m = 0;  // position of a slider whose piston is at the bottom
  double stroke_m = 0;
  double lift_m = 0;
  double friction_n = 0;
  double riser_m3 = 0;
  double cushion_s = 0;
  double effort_scale = 1;
};

class ForcePump final : public Machine {
 public:
  ForcePump(const Build& build, const ForcePumpSettings& settings)
      : s_(settings),
        flow_(build.slot("flow_l_per_s")),
        jet_(build.slot("jet_l_per_s")),
        lifted_l_(build.slot("lifted_l")),
        leaked_l_(build.slot("leaked_l")),
        level_m_(build.slot("level_m")),
        head_m_(build.slot("head_m")),
        force_n_(build.slot("force_n")),
        handle_n_(build.slot("handle_n")),
        strokes_(build.slot("strokes")),
        vessel_m3_(build.slot("vessel.m3")),
        turn_m_(build.slot("stroke.turn_m")),
        rises_(build.slot("stroke.rises", 1)),
        piston_m_(build.slot("piston.0")),
        water_m3_(0),
        known_(0) {
    (void)build.slot("piston.1");
    water_m3_ = build.slot("cylinder.0");
    (void)build.slot("cylinder.1");
    known_ = build.slot("known.0");
    (void)build.slot("known.1");
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    double in_m3 = 0, leaked_m3 = 0, force_n = 0;
    double& vessel_m3 = state.memory[vessel_m3_];
    const double full = s_.riser_m3 > 0 ? std::min(1.0, vessel_m3 / s_.riser_m3) : 1;
    for (std::size_t i = 0; i < s_.cylinders; ++i) {
      const PumpHead head{kWaterDensity_kg_m3 * kGravity_m_s2 * s_.lift_m * full, vessel_m3};
      const PumpFlow flow = move(state, i, head, dt_s);
      vessel_m3 += flow.to_vessel - flow.from_vessel;
      in_m3 += flow.to_vessel - flow.from_vessel;
      leaked_m3 += flow.leaked;
      force_n += flow.force_n;
      load(state, i, flow.force_n);
    }
    const double over_m3 = std::max(0.0, vessel_m3 - s_.riser_m3);
    const double out_m3 = s_.cushion_s > 0 ? over_m3 * (1 - std::exp(-dt_s / s_.cushion_s)) : over_m3;
    vessel_m3 -= out_m3;
    state.memory[flow_] = 1000 * in_m3 / dt_s;
    state.memory[jet_] = 1000 * out_m3 / dt_s;
    state.memory[lifted_l_] += 1000 * out_m3;
    state.memory[leaked_l_] += 1000 * leaked_m3;
    state.memory[level_m_] = s_.basin_m2 > 0 ? 1e-3 * state.memory[lifted_l_] / s_.basin_m2 : 0;
    state.memory[head_m_] = s_.lift_m * full;
    state.memory[force_n_] = force_n;
    state.memory[handle_n_] = handle_force_n(state, force_n);
    count_strokes(state);
  }

 private:
  [[nodiscard]] JointId joint_of(std::size_t i) const noexcept { return s_.beam ? s_.beam : s_.pistons[i]; }

  /// How far a piston is above its bottom.
  [[nodiscard]] double piston_m(const state::JointState& joint, std::size_t i) const noexcept {
    const double side = i == 0 ? s_.direction : -s_.direction;
    const double x_m =
        s_.beam ? s_.stroke_m / 2 + side * s_.arm_m * joint.position : s_.direction * joint.position - s_.bottom_m;
    return std::clamp(x_m, 0.0, s_.stroke_m);
  }

  PumpFlow move(state::WorldState& state, std::size_t i, const PumpHead& head, double dt_s) const noexcept {
    const state::JointState& joint = state[joint_of(i)];
    double& known = state.memory[known_ + i];
    double& at_m = state.memory[piston_m_ + i];
    const double from_m = at_m;
    at_m = piston_m(joint, i);
    const bool moves = joint.enabled && known != 0;  // a piston that was just put in has moved nothing yet
    known = joint.enabled ? 1 : 0;
    if (!moves) return {};
    const double tight = std::min(1.0, std::abs(at_m - from_m) / dt_s / kTight_m_s);
    return move_piston(s_.cylinder[i], from_m, at_m, tight, head, state.memory[water_m3_ + i]);
  }

  void load(state::WorldState& state, std::size_t i, double force_n) const noexcept {
    state::JointState& joint = state[joint_of(i)];
    if (!joint.enabled) return;
    const double lever_m = s_.beam ? s_.arm_m : 1;
    joint.resistance += s_.effort_scale * lever_m * (force_n + s_.friction_n);
  }

  [[nodiscard]] double handle_force_n(const state::WorldState& state, double water_n) const noexcept {
    double pistons_n = water_n;
    for (std::size_t i = 0; i < s_.cylinders; ++i)
      pistons_n += state[joint_of(i)].enabled ? s_.friction_n : 0;
    return pistons_n * s_.arm_m / s_.handle_m;
  }

  /// Counts how often the first piston turns round.
  void count_strokes(state::WorldState& state) const noexcept {
    if (state.memory[known_] == 0) return;
    const double at_m = state.memory[piston_m_];
    double& turn_m = state.memory[turn_m_];
    double& rises = state.memory[rises_];
    turn_m = rises != 0 ? std::max(turn_m, at_m) : std::min(turn_m, at_m);
    if (std::abs(at_m - turn_m) < kTurn * s_.stroke_m) return;
    rises = rises != 0 ? 0 : 1;
    turn_m = at_m;
    state.memory[strokes_] += 1;
  }

  ForcePumpSettings s_;
  std::size_t flow_;
  std::size_t jet_;
  std::size_t lifted_l_;
  std::size_t leaked_l_;
  std::size_t level_m_;
  std::size_t head_m_;
  std::size_t force_n_;
  std::size_t handle_n_;
  std::size_t strokes_;
  std::size_t vessel_m3_;
  std::size_t turn_m_;    // where the first piston last turned round, or the farthest since
  std::size_t rises_;     // 1 while it goes up
  std::size_t piston_m_;  // of each cylinder, from here on
  std::size_t water_m3_;  // under each piston
  std::size_t known_;     // 1: the piston was there in the tick before
};

Expected<void> read_valves(const Build& build, std::string_view name, Valve PumpCylinder::*valve,
                           ForcePumpSettings& s) {
  if (!build.parameters.given(name)) return {};
  const std::vector<std::string> words = build.parameters.texts(name);
  if (words.size() != 1 && words.size() != s.cylinders)
    return fail(ErrorCode::invalid_value,
                std::string(name) + " has " + std::to_string(words.size()) + " words for " +
                    std::to_string(s.cylinders) + " cylinders",
                build.place(name), "write one word for all cylinders, or one for each");
  for (std::size_t i = 0; i < s.cylinders; ++i) {
    const std::string& word = words[words.size() == 1 ? 0 : i];
    if (word == "good") {
      s.cylinder[i].*valve = Valve::good;
    } else if (word == "reversed") {
      s.cylinder[i].*valve = Valve::reversed;
    } else if (word == "missing") {
      s.cylinder[i].*valve = Valve::missing;
    } else {
      return fail(ErrorCode::unknown_name, "a valve cannot be '" + word + "'", build.place(name),
                  "write good, reversed or missing");
    }
  }
  return {};
}

/// What moves the pistons: sliders, or a beam.
Expected<void> read_drive(const Build& build, ForcePumpSettings& s) {
  const state::Parameters& p = build.parameters;
  if (p.given("pistons") == p.given("beam"))
    return fail(p.given("beam") ? ErrorCode::conflict : ErrorCode::missing,
                p.given("beam") ? "both 'pistons' and 'beam' are given" : "neither 'pistons' nor 'beam' is given",
                build.place("beam"), "name the pistons' sliders, or the hinge of the beam that moves them");
  if (p.given("arm")) s.arm_m = s.handle_m = p.number("arm");
  if (p.given("handleArm")) s.handle_m = p.number("handleArm");
  if (p.given("beam")) {
    const auto beam = build.joint("beam", state::JointKind::hinge);
    if (!beam) return tl::unexpected(beam.error());
    s.beam = *beam;
    if (!p.given("arm"))
      return fail(ErrorCode::missing, "the beam has no 'arm'", build.place("beam"),
                  "write its length from the hinge to a piston's rod");
    const auto cylinders = build.whole_number("cylinders");
    if (!cylinders) return tl::unexpected(cylinders.error());
    s.cylinders = static_cast<std::size_t>(*cylinders);
    return {};
  }
  const std::vector<std::string> names = p.texts("pistons");
  if (names.empty() || names.size() > kMostCylinders)
    return fail(ErrorCode::invalid_value, "'pistons' names " + std::to_string(names.size()) + " joints",
                build.place("pistons"), "name one slider or two");
  s.cylinders = names.size();
  for (std::size_t i = 0; i < names.size(); ++i) {
    s.pistons[i] = build.description.find_joint(names[i]);
    if (build.description.joints[s.pistons[i].index()].kind != state::JointKind::slider)
      return fail(ErrorCode::invalid_value, "the joint '" + names[i] + "' in 'pistons' is not a slider",
                  build.place("pistons"), "name SliderJoints");
  }
  return {};
}

Expected<std::unique_ptr<Machine>> make_force_pump(const Build& build) {
  const state::Parameters& p = build.parameters;
  ForcePumpSettings s;
  if (auto good = read_drive(build, s); !good) return tl::unexpected(good.error());
  const double radius_m = p.number("bore") / 2;
  for (PumpCylinder& cylinder : s.cylinder) {
    cylinder.area_m2 = kPi * radius_m * radius_m;
    cylinder.efficiency = p.number("efficiency");
  }
  if (auto good = read_valves(build, "inletValves", &PumpCylinder::inlet, s); !good)
    return tl::unexpected(good.error());
  if (auto good = read_valves(build, "outletValves", &PumpCylinder::outlet, s); !good)
    return tl::unexpected(good.error());
  s.direction = p.boolean("reversed") ? -1 : 1;
  s.bottom_m = p.number("bottom");
  s.stroke_m = p.number("stroke");
  s.lift_m = p.number("lift");
  s.friction_n = p.number("friction");
  s.riser_m3 = p.number("riser") / 1000;
  if (p.given("basinArea")) s.basin_m2 = p.number("basinArea");
  s.cushion_s = p.number("cushion");
  s.effort_scale = build.effort_scale();
  return std::make_unique<ForcePump>(build, s);
}

using state::ParameterKind;
constexpr state::ParameterType kForcePumpParameters[] = {
    {.name = "pistons",
     .kind = ParameterKind::texts,
     .summary = "one slider or two that move the pistons, upwards to positive positions; or see beam",
     .reference = state::Reference::joint},
    {.name = "beam",
     .kind = ParameterKind::text,
     .summary = "the hinge of the beam that moves the pistons; level, with both half way, at angle 0",
     .reference = state::Reference::joint},
    {.name = "arm", .unit = "m", .summary = "of the beam, from its hinge to a piston's rod", .min = 0.01, .max = 10},
    {.name = "handleArm",
     .unit = "m",
     .summary = "of the beam, from its hinge to the hand; not given: as arm. With sliders both only tell handle_n",
     .min = 0.01,
     .max = 10},
    {.name = "cylinders", .summary = "under a beam: 1 or 2", .default_value = 2, .min = 1, .max = 2},
    {.name = "bore", .unit = "m", .summary = "of a cylinder, inside", .required = true, .min = 0.005, .max = 1},
    {.name = "stroke", .unit = "m", .summary = "of a piston", .required = true, .min = 0.005, .max = 2},
    {.name = "bottom",
     .unit = "m",
     .summary = "of sliders: the position at which a piston is at the bottom",
     .min = -10,
     .max = 10},
    {.name = "lift",
     .unit = "m",
     .summary = "from the well's surface to the trumpet's mouth",
     .required = true,
     .min = 0.01,
     .max = 100},
    {.name = "efficiency",
     .summary = "share of the displaced water that is lifted, 0 to 1",
     .default_value = 0.8,
     .min = 0.05,
     .max = 1},
    {.name = "friction", .unit = "N", .summary = "of each piston's leather", .min = 0, .max = 1e5},
    {.name = "inletValves",
     .kind = ParameterKind::texts,
     .summary = "in the cylinders' bottoms: good, reversed or missing; one word, or one for each cylinder"},
    {.name = "outletValves",
     .kind = ParameterKind::texts,
     .summary = "over the forked pipe's ends: good, reversed or missing; one word, or one for each cylinder"},
    {.name = "riser",
     .unit = "l",
     .summary = "vessel and pipe up to the mouth: filled before the first water comes",
     .default_value = 1,
     .min = 0,
     .max = 1e4},
    {.name = "cushion",
     .unit = "s",
     .summary = "how long the air under the cowl takes to give back two thirds of a pulse; 0: no air",
     .default_value = 0.3,
     .min = 0,
     .max = 100},
    {.name = "basinArea",
     .unit = "m2",
     .summary = "of the water in the tub that the jet falls into",
     .min = 1e-4,
     .max = 1e6},
    effort_scale_parameter("share of the load that the hand feels; not given: the world's effort_scale"),
    {.name = "reversed",
     .kind = ParameterKind::boolean,
     .summary = "true: the (first) piston rises when its joint goes to negative positions"},
};
constexpr state::ValueType kForcePumpValues[] = {
    {"flow_l_per_s", "l/s", "what comes into the vessel now; negative where it runs back"},
    state::amount("jet_l_per_s", "l/s", "what leaves the trumpet now"),
    state::amount("lifted_l", "l", "out of the trumpet so far"),
    state::amount("leaked_l", "l", "past the pistons so far"),
    state::amount("level_m", "m", "of the water in the tub over its floor; 0 where no basinArea is given"),
    state::amount("head_m", "m", "of the water over the well", "lift"),
    state::amount("force_n", "N", "of the water on the pressing pistons, unscaled"),
    state::amount("handle_n", "N", "what pistons and friction ask of the hand, unscaled"),
    state::amount("strokes", "", "how often the first piston has turned round"),
};

}  // namespace

const MachineKind& force_pump_kind() {
  static const MachineKind kKind{
      {"machine.force_pump", "Ktesibios' pump: pistons and valves lift water", kForcePumpParameters, kForcePumpValues},
      make_force_pump};
  return kKind;
}

}  // namespace mechane::machines
