// machine.screw_pump: Archimedes' screw between a river and a basin.
//
// Water. A turn lifts what the geometry holds (screw_geometry.hpp). It travels up with the blades as a train of buckets, so that the
// first water comes out after length / pitch turns, and turning backwards brings it down again. Above Muysken's limit n_M a share of
// what arrives at the top is thrown back over the core and runs down into the river. The share that stays, (n_M / n)^2, is this
// model's own: Muysken gives only the limit, and says that 'increasingly more' is lost beyond it. So the flow is continuous at the
// limit and falls beyond it. At standstill the buckets leak with the time constant leakTime. Above 2 turns a minute the leak is left
// out, because each bucket gets back what it loses from the one above it (Nagel's gap flow would lose a share of the lift; this screw
// is tight, sealed with pitch).
//
// Load. A full screw's water asks for a torque of V rho g H / (2 pi) at the crank, divided by the efficiency (Rorres 2000; efficiency
// 0.7); less in proportion when it is not full. Times effort_scale it goes to the joint as a resistance, which holds but never drives:
// a real screw that is let go may run back, but this one stands and leaks, so that no machine turns a visitor's hand.
// When the screw turns backwards the water helps: only the losses, 1 - efficiency of the load, are left.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"
#include "server/machines/screw_geometry.hpp"
#include "server/machines/screw_train.hpp"

namespace mechane::machines {
namespace {

constexpr double kTightRate_rad_s = 2.0 * 2 * kPi / 60;  // above it buckets do not leak
constexpr double kStill_rad_s = 1e-9;                    // a slower screw stands: the rest is rounding
constexpr double kBackBlend_rad_s = 0.2;                 // over this range the load changes from forwards to backwards
constexpr double kEventPeriod_s = 0.5;
constexpr double kEventLeast_m3 = 1e-5;  // a cup's drop is not an event
constexpr std::size_t kMostBuckets = 256;

struct ScrewPumpSettings {
  JointId joint;
  double direction = 1;
  double volume_per_turn_m3 = 0;
  double limit_rad_s = 0;
  double torque_full_nm = 0;  // of the water, at the crank, efficiency included
  double efficiency = 0.7;
  double effort_scale = 1;
  double leak_s = 0;
  double basin_m2 = 0;
  double basin_capacity_m3 = 0;
  double basin_start_m3 = 0;
  double buckets_per_turn = 0;
  std::size_t buckets = 0;
};

class ScrewPump final : public Machine {
 public:
  ScrewPump(const Build& build, const ScrewPumpSettings& settings)
      : s_(settings),
        id_(build.id),
        basin_l_(build.slot("basin_l", 1000 * settings.basin_start_m3)),
        level_m_(build.slot("level_m", settings.basin_start_m3 / settings.basin_m2)),
        flow_(build.slot("flow_l_per_s")),
        spill_(build.slot("spill_l_per_s")),
        lifted_l_(build.slot("lifted_l")),
        torque_nm_(build.slot("torque_nm")),
        filled_(build.slot("filled")),
        phase_(build.slot("train.phase")),
        first_bucket_(build.slot("train.bucket0")),
        unsaid_m3_(0),
        since_event_s_(0) {
    for (std::size_t i = 1; i <= s_.buckets; ++i)
      (void)build.slot("train.bucket" + std::to_string(i));
    unsaid_m3_ = build.slot("spill.unsaid_m3");
    since_event_s_ = build.slot("spill.since_event_s", kEventPeriod_s);
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    state::JointState& joint = state[s_.joint];
    const bool turns = joint.enabled && std::abs(joint.velocity) > kStill_rad_s;
    const double rate = turns ? s_.direction * joint.velocity : 0;  // rad/s, > 0 lifts
    BucketTrain train(std::span(state.memory).subspan(first_bucket_, s_.buckets + 1), state.memory[phase_],
                      s_.volume_per_turn_m3 / s_.buckets_per_turn);
    const TrainFlow flow = train.move(rate * dt_s / (2 * kPi) * s_.buckets_per_turn);
    const double tight = std::min(1.0, std::abs(rate) / kTightRate_rad_s);
    train.leak((1 - tight) * dt_s / s_.leak_s);

    const double stays = rate > s_.limit_rad_s ? (s_.limit_rad_s / rate) * (s_.limit_rad_s / rate) : 1;
    const double lifted_m3 = stays * flow.poured;
    const double overflow_m3 = fill_basin(state, lifted_m3);
    const double spilled_m3 = flow.poured - lifted_m3 + overflow_m3;
    state.memory[flow_] = 1000 * lifted_m3 / dt_s;
    state.memory[spill_] = 1000 * spilled_m3 / dt_s;
    state.memory[lifted_l_] += 1000 * lifted_m3;
    say_spilled(state, spilled_m3, dt_s);
    load_joint(state, joint, train, rate);
  }

 private:
  /// Returns what runs over the rim.
  double fill_basin(state::WorldState& state, double lifted_m3) const noexcept {
    const double wanted_m3 = state.memory[basin_l_] / 1000 + lifted_m3;
    const double kept_m3 = std::min(wanted_m3, s_.basin_capacity_m3);
    state.memory[basin_l_] = 1000 * kept_m3;
    state.memory[level_m_] = kept_m3 / s_.basin_m2;
    return wanted_m3 - kept_m3;
  }

  void load_joint(state::WorldState& state, state::JointState& joint, const BucketTrain& train,
                  double rate) const noexcept {
    const double whole_m3 = s_.volume_per_turn_m3 / s_.buckets_per_turn * static_cast<double>(s_.buckets);
    const double filled = std::min(1.0, train.content_m3() / whole_m3);
    const double back = std::clamp(-rate / kBackBlend_rad_s, 0.0, 1.0);
    const double torque_nm = s_.torque_full_nm * filled * (1 - s_.efficiency * back);
    state.memory[filled_] = filled;
    state.memory[torque_nm_] = torque_nm;
    joint.resistance += s_.effort_scale * torque_nm;
  }

  void say_spilled(state::WorldState& state, double spilled_m3, double dt_s) const noexcept {
    double& unsaid_m3 = state.memory[unsaid_m3_];
    double& since_s = state.memory[since_event_s_];
    unsaid_m3 += spilled_m3;
    since_s = std::min(since_s + dt_s, kEventPeriod_s);
    if (since_s < kEventPeriod_s || unsaid_m3 < kEventLeast_m3) return;
    state.emit(state::EventKind::spilled, static_cast<std::uint32_t>(id_.index()), 0xffffffffu, unsaid_m3);
    unsaid_m3 = 0;
    since_s = 0;
  }

  ScrewPumpSettings s_;
  MachineId id_;
  std::size_t basin_l_;
  std::size_t level_m_;
  std::size_t flow_;
  std::size_t spill_;
  std::size_t lifted_l_;
  std::size_t torque_nm_;
  std::size_t filled_;
  std::size_t phase_;
  std::size_t first_bucket_;  // the others follow
  std::size_t unsaid_m3_;
  std::size_t since_event_s_;
};

Expected<ScrewShape> read_shape(const Build& build) {
  const state::Parameters& p = build.parameters;
  ScrewShape shape;
  shape.outer_radius_m = p.number("diameter") / 2;
  shape.core_radius_m = p.given("coreDiameter") ? p.number("coreDiameter") / 2 : shape.outer_radius_m / 2;
  shape.pitch_m = p.given("pitch") ? p.number("pitch") : 2 * kPi * shape.core_radius_m;
  shape.slope_rad = p.number("slope");
  const auto blades = build.whole_number("blades");
  if (!blades) return tl::unexpected(blades.error());
  shape.blades = static_cast<int>(*blades);
  if (shape.core_radius_m >= shape.outer_radius_m)
    return fail(ErrorCode::conflict, "the core is as thick as the screw", build.place("coreDiameter"),
                "make coreDiameter smaller than diameter");
  if (!holds_water(shape))
    return fail(ErrorCode::conflict, "a screw of this pitch and slope holds no water: it runs down over the core",
                build.place("slope"), "make pitch * tan(slope) smaller than the core's circumference");
  return shape;
}

Expected<std::unique_ptr<Machine>> make_screw_pump(const Build& build) {
  const state::Parameters& p = build.parameters;
  const auto shape = read_shape(build);
  if (!shape) return tl::unexpected(shape.error());
  ScrewPumpSettings s;
  const auto joint = build.joint("joint", state::JointKind::hinge);
  if (!joint) return tl::unexpected(joint.error());
  s.joint = *joint;
  const double turns = p.number("length") / shape->pitch_m;
  const double buckets = std::round(turns * shape->blades);
  if (buckets < 1 || buckets > static_cast<double>(kMostBuckets))
    return fail(
        ErrorCode::conflict, fmt::format("the screw has {} buckets", buckets), build.place("length"),
        "choose length, pitch and blades so that length / pitch * blades is from 1 to " + std::to_string(kMostBuckets));
  s.buckets = static_cast<std::size_t>(buckets);
  s.buckets_per_turn = buckets / turns;
  s.direction = p.boolean("reversed") ? -1 : 1;
  s.volume_per_turn_m3 = volume_per_turn_m3(*shape);
  s.limit_rad_s = muysken_limit_rad_s(p.number("diameter"));
  s.efficiency = p.number("efficiency");
  s.torque_full_nm =
      s.volume_per_turn_m3 * kWaterDensity_kg_m3 * kGravity_m_s2 * p.number("lift") / (2 * kPi) / s.efficiency;
  s.effort_scale = build.effort_scale();
  s.leak_s = p.number("leakTime");
  s.basin_m2 = p.number("basinArea");
  s.basin_capacity_m3 = p.number("basinCapacity") / 1000;
  s.basin_start_m3 = std::min(p.number("basinStart") / 1000, s.basin_capacity_m3);
  return std::make_unique<ScrewPump>(build, s);
}

using state::ParameterKind;
constexpr state::ParameterType kScrewPumpParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge that turns the screw",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "diameter", .unit = "m", .summary = "over the blades", .required = true, .min = 0.01, .max = 20},
    {.name = "length", .unit = "m", .summary = "of the bladed part", .required = true, .min = 0.01, .max = 200},
    {.name = "pitch",
     .unit = "m",
     .summary = "advance of a blade in a turn; not given: the core's circumference (Vitruvius)",
     .min = 0.001,
     .max = 50},
    {.name = "coreDiameter",
     .unit = "m",
     .summary = "of the core; not given: half the diameter (Vitruvius)",
     .min = 0.001,
     .max = 20},
    {.name = "blades", .summary = "how many", .default_value = 8, .min = 1, .max = 32},
    {.name = "slope",
     .unit = "rad",
     .summary = "of the axis against the horizontal; Vitruvius' triangle of 3, 4, 5 has 0.6435",
     .default_value = 0.6435011087932844,
     .min = 0.01,
     .max = 1.55},
    {.name = "lift",
     .unit = "m",
     .summary = "from the river's surface to the outlet",
     .required = true,
     .min = 0.01,
     .max = 100},
    {.name = "efficiency", .summary = "of the lifting, 0 to 1", .default_value = 0.7, .min = 0.05, .max = 1},
    effort_scale_parameter("share of the load that the hand feels; not given: the world's effort_scale"),
    {.name = "reversed",
     .kind = ParameterKind::boolean,
     .summary = "true: the screw lifts when the hinge turns to negative angles"},
    {.name = "leakTime",
     .unit = "s",
     .summary = "in which a standing screw loses two thirds of its water",
     .default_value = 20,
     .min = 0.1,
     .max = 1e6},
    {.name = "basinArea",
     .unit = "m2",
     .summary = "of the basin's water surface",
     .required = true,
     .min = 1e-4,
     .max = 1e6},
    {.name = "basinCapacity", .unit = "l", .summary = "up to the rim", .required = true, .min = 0.001, .max = 1e9},
    {.name = "basinStart", .unit = "l", .summary = "in the basin at the start", .min = 0, .max = 1e9},
};
constexpr state::ValueType kScrewPumpValues[] = {
    state::amount("basin_l", "l", "water in the basin", "basinCapacity"),
    state::amount("level_m", "m", "of the basin's water over its floor"),
    state::amount("flow_l_per_s", "l/s", "what comes into the basin now"),
    state::amount("spill_l_per_s", "l/s", "what runs back over the core or over the basin's rim now"),
    state::amount("lifted_l", "l", "lifted to the outlet so far"),
    state::amount("torque_nm", "N m", "what the water asks of the crank, unscaled"),
    {"filled", "", "share of the screw that is full of water, 0 to 1", 0, 1},
};

}  // namespace

const MachineKind& screw_pump_kind() {
  static const MachineKind kKind{
      {"machine.screw_pump", "Archimedes' screw: lifts water as a hinge turns", kScrewPumpParameters, kScrewPumpValues},
      make_screw_pump};
  return kKind;
}

}  // namespace mechane::machines
