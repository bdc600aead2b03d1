// machine.steam_sphere: the sphere of Aiolos (Heron, Pneumatica II.11): a fire, a cauldron, a sphere with bent nozzles.
//
// Heat. m c dT/dt = fire - loss * (T - ambient) up to 100 degrees C; from then on the power boils water away, dm/dt = P / latent heat.
// All of this, and the use of water, runs `timeScale` times as fast as the clock. The flow of steam is that of real time, so that the
// sphere turns as a real one does. The space that the steam fills smooths the flow by `steamDelay` seconds.
//
// Jet. Steam leaves the nozzles at v = flow / (density * their area), at about the pressure of the air, and takes its angular momentum
// with it: torque = sum over the nozzles of their flow * r * (v cos(phi) - omega r), phi the nozzle's angle from the tangent. A nozzle
// bent the wrong way (phi = pi) works against the others. The bearing's friction and the drag of the air, c omega^2, limit the speed.
// Torque and drag go to the hinge as load and resistance, times effort_scale.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"

namespace mechane::machines {
namespace {

constexpr double kBoiling_c = 100;
constexpr double kFastest_m_s = 250;      // beyond this, the pressure in the sphere is no longer near that of the air
constexpr double kLeastWater_kg = 0.005;  // the cauldron's floor warms too: as much heat as this much water takes
constexpr std::size_t kMostNozzles = 8;

struct SteamSphereSettings {
  JointId joint;
  QuantityId fire;  // none where an agent lights it
  std::string lit_by;
  double direction = 1;
  double fire_w = 0;
  double loss_w_per_k = 0;
  double ambient_c = 20;
  double water_kg = 1;
  double time_scale = 1;
  double delay_s = 0.5;
  double radius_m = 0;
  double area_m2 = 0;      // of all nozzles
  double mean_cosine = 1;  // over the nozzles
  bool lid = true;
  double bearing_nm = 0;
  double air_nm_s2 = 0;
  double effort_scale = 1;
};

class SteamSphere final : public Machine {
 public:
  SteamSphere(const Build& build, const SteamSphereSettings& settings)
      : s_(settings),
        where_(build.place("litBy")),
        temperature_(build.slot("temperature_c", settings.ambient_c)),
        steam_(build.slot("steam_kg_s")),
        water_(build.slot("water_l", settings.water_kg)),
        rate_(build.slot("rate")),
        torque_(build.slot("torque_nm")),
        exit_(build.slot("exit_m_s")),
        boils_(build.slot("boils")) {}

  Expected<void> link(const state::MemoryLayout& layout) override {
    if (s_.fire) return {};
    const state::MemorySlot* slot = layout.find(s_.lit_by + ".lit");
    if (slot == nullptr)
      return fail(ErrorCode::invalid_value, "the agent '" + s_.lit_by + "' has no value 'lit'", where_,
                  "name a simulation.lit in 'litBy'");
    lit_ = slot->index;
    return {};
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    const double boiled_kg_s = heat(state, dt_s * s_.time_scale);
    double& steam_kg_s = state.memory[steam_];
    steam_kg_s += (boiled_kg_s - steam_kg_s) * std::min(1.0, dt_s / s_.delay_s);
    state.memory[boils_] = boiled_kg_s > 0 ? 1 : 0;
    spin(state, s_.lid ? steam_kg_s : 0);
  }

 private:
  [[nodiscard]] bool lit(const state::WorldState& state) const noexcept {
    return (s_.fire ? state.quantities[s_.fire.index()] : state.memory[lit_]) > 0.5;
  }

  /// Heats for `time_s` of the cauldron's own time; returns the steam that comes off, kg/s.
  double heat(state::WorldState& state, double time_s) const noexcept {
    double& temperature_c = state.memory[temperature_];
    double& water_kg = state.memory[water_];  // a litre to the kilogram
    const bool burns = lit(state) && water_kg > 0;
    const double power_w = (burns ? s_.fire_w : 0) - s_.loss_w_per_k * (temperature_c - s_.ambient_c);
    const double capacity_j_per_k = std::max(water_kg, kLeastWater_kg) * kWaterHeat_j_per_kg_k;
    const double wanted_c = temperature_c + power_w * time_s / capacity_j_per_k;
    temperature_c = std::clamp(wanted_c, s_.ambient_c, kBoiling_c);
    const double left_j = (wanted_c - temperature_c) * capacity_j_per_k;
    if (left_j <= 0 || wanted_c < kBoiling_c) return 0;
    const double boiled_kg = std::min(left_j / kEvaporation_j_per_kg, water_kg);
    water_kg -= boiled_kg;
    return boiled_kg / time_s;
  }

  void spin(state::WorldState& state, double flow_kg_s) const noexcept {
    state::JointState& joint = state[s_.joint];
    const double rate = joint.enabled ? s_.direction * joint.velocity : 0;
    const double exit_m_s = flow_kg_s / (kSteamDensity_kg_m3 * s_.area_m2);
    const double torque_nm = flow_kg_s * s_.radius_m * (exit_m_s * s_.mean_cosine - rate * s_.radius_m);
    state.memory[rate_] = rate;
    state.memory[exit_] = exit_m_s;
    state.memory[torque_] = torque_nm;
    if (!joint.enabled) return;
    joint.load += s_.effort_scale * s_.direction * torque_nm;
    joint.resistance += s_.effort_scale * (s_.bearing_nm + s_.air_nm_s2 * rate * rate);
  }

  SteamSphereSettings s_;
  Place where_;  // for link()
  std::size_t lit_ = 0;
  std::size_t temperature_;
  std::size_t steam_;
  std::size_t water_;
  std::size_t rate_;
  std::size_t torque_;
  std::size_t exit_;
  std::size_t boils_;
};

Expected<void> read_nozzles(const Build& build, SteamSphereSettings& s) {
  const state::Parameters& p = build.parameters;
  const std::vector<double> angles = p.given("nozzleAngles") ? p.numbers("nozzleAngles") : std::vector<double>{0, 0};
  if (angles.empty() || angles.size() > kMostNozzles)
    return fail(ErrorCode::invalid_value, fmt::format("'nozzleAngles' has {} angles", angles.size()),
                build.place("nozzleAngles"), fmt::format("write from 1 to {} angles", kMostNozzles));
  double sum = 0;
  for (const double angle : angles)
    sum += std::cos(angle);
  const auto count = static_cast<double>(angles.size());
  s.mean_cosine = sum / count;
  const double bore_m = p.number("nozzleDiameter");
  s.area_m2 = count * kPi * bore_m * bore_m / 4;
  const double exit_m_s = s.fire_w / kEvaporation_j_per_kg / (kSteamDensity_kg_m3 * s.area_m2);
  if (exit_m_s > kFastest_m_s) {
    return fail(ErrorCode::conflict,
                fmt::format("the steam of {:.0f} W would leave these nozzles at {:.0f} m/s", s.fire_w, exit_m_s),
                build.place("nozzleDiameter"),
                fmt::format("write {:.4f} or more for nozzleDiameter: the formula holds up to {:.0f} m/s",
                            bore_m * std::sqrt(exit_m_s / kFastest_m_s), kFastest_m_s));
  }
  return {};
}

/// What lights the fire: a quantity, or an agent.
Expected<void> read_fire(const Build& build, SteamSphereSettings& s) {
  const state::Parameters& p = build.parameters;
  if (p.given("fire") == p.given("litBy")) {
    return fail(p.given("fire") ? ErrorCode::conflict : ErrorCode::missing,
                p.given("fire") ? "both 'fire' and 'litBy' are given" : "neither 'fire' nor 'litBy' is given",
                build.place("litBy"), "name a quantity in 'fire', or a simulation.lit in 'litBy': one of the two");
  }
  if (p.given("fire")) {
    s.fire = build.description.find_quantity(p.text("fire"));
    return {};
  }
  s.lit_by = p.text("litBy");
  if (build.agent(p.agent("litBy")).type != "simulation.lit")
    return fail(ErrorCode::invalid_value, "the agent '" + s.lit_by + "' in 'litBy' is not a simulation.lit",
                build.place("litBy"), "name a simulation.lit in 'litBy'");
  return {};
}

Expected<std::unique_ptr<Machine>> make_steam_sphere(const Build& build) {
  const state::Parameters& p = build.parameters;
  SteamSphereSettings s;
  const auto joint = build.joint("joint", state::JointKind::hinge);
  if (!joint) return tl::unexpected(joint.error());
  s.joint = *joint;
  if (auto good = read_fire(build, s); !good) return tl::unexpected(good.error());
  s.direction = p.boolean("reversed") ? -1 : 1;
  s.fire_w = p.number("firePower");
  s.loss_w_per_k = p.number("loss");
  s.ambient_c = p.number("ambient");
  if (s.loss_w_per_k * (kBoiling_c - s.ambient_c) >= s.fire_w)
    return fail(ErrorCode::conflict, "this fire never boils the water: the cauldron loses more than it gets",
                build.place("loss"),
                fmt::format("write less than {:.2f} for loss", s.fire_w / (kBoiling_c - s.ambient_c)));
  s.water_kg = p.number("water");
  s.time_scale = p.number("timeScale");
  s.delay_s = p.number("steamDelay");
  s.radius_m = p.number("nozzleRadius");
  s.lid = p.boolean("lid");
  s.bearing_nm = p.number("bearing");
  s.air_nm_s2 = p.number("airDrag");
  s.effort_scale = build.effort_scale();
  if (auto good = read_nozzles(build, s); !good) return tl::unexpected(good.error());
  return std::make_unique<SteamSphere>(build, s);
}

using state::ParameterKind;
constexpr state::ParameterType kSteamSphereParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge that the sphere turns on",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "fire",
     .kind = ParameterKind::text,
     .summary = "the quantity that is above 0.5 while the fire burns; or write litBy",
     .reference = state::Reference::quantity},
    {.name = "litBy",
     .kind = ParameterKind::text,
     .summary = "the simulation.lit that says whether the fire burns; or write fire",
     .reference = state::Reference::agent},
    {.name = "firePower", .unit = "W", .summary = "of the fire into the water", .required = true, .min = 1, .max = 1e6},
    {.name = "water",
     .unit = "l",
     .summary = "in the cauldron at the start",
     .default_value = 1,
     .min = 0,
     .max = 1000},
    {.name = "ambient",
     .unit = "degC",
     .summary = "around, and of the water at the start",
     .default_value = 20,
     .min = -20,
     .max = 60},
    {.name = "loss", .unit = "W/K", .summary = "what the cauldron gives to the air", .min = 0, .max = 1e4},
    {.name = "timeScale",
     .summary = "how many times as fast as the clock the water heats and is used up",
     .default_value = 1,
     .min = 1,
     .max = 1000},
    {.name = "steamDelay",
     .unit = "s",
     .summary = "by which the flow of steam follows the boiling, real time",
     .default_value = 0.5,
     .min = 0.01,
     .max = 100},
    {.name = "nozzleRadius",
     .unit = "m",
     .summary = "from the sphere's axis to a nozzle's mouth",
     .required = true,
     .min = 0.005,
     .max = 5},
    {.name = "nozzleDiameter", .unit = "m", .summary = "of a nozzle's bore", .required = true, .min = 1e-4, .max = 0.5},
    {.name = "nozzleAngles",
     .kind = ParameterKind::numbers,
     .unit = "rad",
     .summary = "of each nozzle's jet, from the tangent against the turning; pi: bent the wrong way. Not given: 0 0",
     .min = -7,
     .max = 7},
    {.name = "lid",
     .kind = ParameterKind::boolean,
     .summary = "false: the cauldron is open, and no steam reaches the sphere",
     .default_value = 1},
    {.name = "bearing", .unit = "N m", .summary = "friction of the two pivots", .min = 0, .max = 1e3},
    {.name = "airDrag",
     .unit = "N m s2/rad2",
     .summary = "torque of the air at 1 rad/s; it grows with the square of the rate",
     .min = 0,
     .max = 1e3},
    effort_scale_parameter(
        "share of the torques that is applied; not given: the world's effort_scale, as for the sphere's mass"),
    {.name = "reversed",
     .kind = ParameterKind::boolean,
     .summary = "true: the nozzles drive the hinge to negative angles"},
};
constexpr state::ValueType kSteamSphereValues[] = {
    {.name = "temperature_c", .unit = "degC", .summary = "of the water", .max = kBoiling_c},
    state::amount("steam_kg_s", "kg/s", "that comes off the water, in real time"),
    state::amount("water_l", "l", "left in the cauldron", "water"),
    {"rate", "rad/s", "of the sphere; the unit rpm converts"},
    {"torque_nm", "N m", "of the jets, unscaled"},
    state::amount("exit_m_s", "m/s", "of the steam out of the nozzles"),
    state::yes_or_no("boils", "1 while the water boils"),
};

}  // namespace

const MachineKind& steam_sphere_kind() {
  static const MachineKind kKind{{"machine.steam_sphere", "A fire boils water, and jets of steam turn a sphere",
                                  kSteamSphereParameters, kSteamSphereValues},
                                 make_steam_sphere};
  return kKind;
}

}  // namespace mechane::machines
