// machine.water_network: vessels, pipes, valves, siphons, shut-in air, feeds and floats. How water flows is in water_flow.hpp, what an
// author writes in water_network_text.hpp; here is the tick.
//
// Feeds pour first; then the pipes run in the order in which they are written, each for the whole tick; then what stands over a rim is
// spilled. The water in all vessels, delivered and spilled is always what there was at the start and what feeds supplied. Formulas see
// joints of this tick, and the network's own values and quantities of the tick before.
//
// A float is lifted by the water that its prism displaces (Archimedes), and half critically damped, as a body in water is: what it
// displaces does not raise the level. Loads are scaled as their body's mass is, so that it swims as deep as the real one.
#include "server/machines/water_network.hpp"

#include <algorithm>
#include <cmath>

#include "server/machines/machine.hpp"
#include "server/machines/nature.hpp"
#include "server/machines/water_network_text.hpp"

namespace mechane::machines {
namespace {

constexpr double kMostFeed_m3_s = 10;

class WaterNetwork final : public Machine {
 public:
  WaterNetwork(const Build& build, NetworkSettings settings) : s_(std::move(settings)) {
    for (std::size_t i = 0; i < s_.memory.size(); ++i) {
      const std::size_t slot = build.slot(s_.names[i], s_.memory[i]);
      if (i == 0) base_ = slot;
    }
    for (const VesselLoad& load : s_.loads)
      weights_.push_back(load.body ? build.description.bodies[load.body.index()].effort_scale : 0);
    for (const Float& each : s_.floats)
      lifts_.push_back(build.description.bodies[each.body.index()].effort_scale);
  }

  void run(state::WorldState& state, double dt_s) const noexcept override {
    const std::span<double> memory = std::span(state.memory).subspan(base_, s_.memory.size());
    Tick tick{memory,
              {state.joints, state.quantities, memory},
              {s_.vessels, memory.subspan(s_.slots.water, s_.vessels.size()), memory.subspan(s_.slots.air, s_.airs)},
              dt_s,
              dt_s * s_.time_scale};
    listen(tick);
    pour(tick);
    run_pipes(tick);
    settle(tick);
    for (std::size_t i = 0; i < s_.vessels.size(); ++i)
      weigh(state, tick, i);
    for (std::size_t i = 0; i < s_.floats.size(); ++i)
      lift(state, tick, i);
    if (tick.fault) memory[s_.slots.faults] += 1;
    for (const ShownValue& value : s_.shown)
      memory[value.shown] = memory[value.si] / value.factor;
  }

 private:
  struct Tick {
    std::span<double> memory;
    Surroundings around;
    Waters waters;
    double dt_s = 0;    // by the clock, for formulas
    double time_s = 0;  // in which water flows
    bool fault = false;

    double value_of(const std::vector<Op>& ops) noexcept {
      const Result result = evaluate(ops, around, dt_s);
      fault = fault || result.fault;
      return result.value;
    }
  };

  /// All formulas, before anything has moved.
  void listen(Tick& tick) const noexcept {
    for (std::size_t i = 0; i < s_.pipes.size(); ++i) {
      if (!s_.open[i].empty()) tick.memory[s_.slots.open + i] = tick.value_of(s_.open[i]);
    }
    for (std::size_t i = 0; i < s_.feeds.size(); ++i)
      tick.memory[s_.slots.wanted + i] = std::clamp(tick.value_of(s_.feeds[i].flow), 0.0, kMostFeed_m3_s);
    for (std::size_t i = 0; i < s_.vessels.size(); ++i) {
      if (!s_.loads[i].vent.empty()) tick.memory[s_.slots.vent + i] = tick.value_of(s_.loads[i].vent);
    }
  }

  void pour(Tick& tick) const noexcept {
    for (std::size_t i = 0; i < s_.feeds.size(); ++i) {
      const std::size_t into = s_.feeds[i].into;
      const double wanted_m3 = tick.memory[s_.slots.wanted + i] * tick.time_s;
      const double poured_m3 = std::min(wanted_m3, room_m3(tick.waters, into));
      tick.waters.water_m3[into] += poured_m3;
      tick.memory[s_.slots.supplied] += poured_m3;
      tick.memory[s_.slots.poured + i] = poured_m3 / tick.time_s;
    }
  }

  void run_pipes(Tick& tick) const noexcept {
    for (std::size_t i = 0; i < s_.pipes.size(); ++i) {
      const double moved_m3 =
          flow(s_.pipes[i], tick.waters, tick.memory[s_.slots.open + i], tick.memory[s_.slots.primed + i], tick.time_s);
      tick.memory[s_.slots.flow + i] = moved_m3 / tick.time_s;
      if (s_.pipes[i].to == kOpenAir) tick.memory[s_.slots.delivered] += moved_m3;
    }
  }

  /// What stands over a rim runs off, air goes where a vent is open, and the rest is told.
  void settle(Tick& tick) const noexcept {
    for (std::size_t i = 0; i < s_.vessels.size(); ++i) {
      const Vessel& vessel = s_.vessels[i];
      double& water_m3 = tick.waters.water_m3[i];
      const double over_m3 = vessel.air == kOpenAir ? std::max(0.0, water_m3 - vessel.capacity_m3()) : 0;
      if (over_m3 > 0) water_m3 = vessel.capacity_m3();
      tick.memory[s_.slots.spilled] += over_m3;
      tick.memory[s_.slots.overflow + i] = over_m3 / tick.time_s;
      tick.memory[s_.slots.level + i] = water_m3 / vessel.area_m2;
    }
    for (std::size_t i = 0; i < s_.vessels.size(); ++i) {
      if (!(tick.memory[s_.slots.vent + i] > 0.5)) continue;
      const std::size_t air = s_.vessels[i].air;
      tick.waters.air_pa_m3[air] = kAtmosphere_pa * air_volume_m3(tick.waters, air);
    }
    for (std::size_t i = 0; i < s_.vessels.size(); ++i)
      tick.memory[s_.slots.pressure + i] = gauge_pa(tick.waters, i);
  }

  void weigh(state::WorldState& state, const Tick& tick, std::size_t i) const noexcept {
    if (!s_.loads[i].body) return;
    state::BodyState& body = state[s_.loads[i].body];
    const double weight_n = std::min(kWaterWeight_n_m3 * tick.waters.water_m3[i], s_.limit_n);
    state::add_force(body, Vec3(0, -weights_[i] * weight_n, 0), body.X_WB.p);
  }

  void lift(state::WorldState& state, const Tick& tick, std::size_t i) const noexcept {
    const Float& each = s_.floats[i];
    state::BodyState& body = state[each.body];
    const double surface_m = s_.vessels[each.in].floor_m + tick.memory[s_.slots.level + each.in];
    const double depth_m = std::clamp(surface_m - (body.X_WB.p.y() + each.bottom_m), 0.0, each.height_m);
    const double drag_n = depth_m / each.height_m * each.drag_n_s_m * body.V_WB.v.y();
    const double wanted_n = kWaterWeight_n_m3 * each.area_m2 * depth_m - drag_n;
    const double lift_n = std::isfinite(wanted_n) ? std::clamp(wanted_n, -s_.limit_n, s_.limit_n) : 0;
    tick.memory[s_.slots.lift + i] = lift_n;
    state::add_force(body, Vec3(0, lifts_[i] * lift_n, 0), body.X_WB.p);
  }

  NetworkSettings s_;
  std::size_t base_ = 0;
  std::vector<double> weights_, lifts_;  // effort scales of the bodies
};

Expected<std::unique_ptr<Machine>> make_water_network(const Build& build) {
  auto settings = read_network(build);
  if (!settings) return tl::unexpected(settings.error());
  return std::make_unique<WaterNetwork>(build, std::move(*settings));
}

constexpr state::ParameterType parts_parameter(std::string_view name, std::string_view summary, bool required = false) {
  return {.name = name,
          .kind = state::ParameterKind::texts,
          .summary = summary,
          .required = required,
          .reference = state::Reference::expression};
}

constexpr state::ParameterType kNetworkParameters[] = {
    parts_parameter("vessels", "each `NAME: area 0.02 m2, height 0.3 m`; see *Water networks*", true),
    parts_parameter("pipes", "each `NAME: from VESSEL at 0.5 m, to air, bore 8 mm`"),
    parts_parameter("feeds", "each `NAME: into VESSEL, flow 2 l/min`"),
    parts_parameter("floats", "each `NAME: in VESSEL, of BODY.body, area 40 cm2, height 3 cm`"),
    {.name = "timeScale",
     .summary = "how many times as fast as the clock the water flows",
     .default_value = 1,
     .min = 0.01,
     .max = 1000},
    {.name = "limit",
     .unit = "N",
     .summary = "the most that a float's lift or the weight of a vessel's water comes to",
     .default_value = 1000,
     .min = 0,
     .max = 1e5},
};
constexpr state::ValueType kNetworkValues[] = {
    state::amount("supplied_l", "l", "that feeds have poured"),
    state::amount("delivered_l", "l", "that has left by pipes into the open"),
    state::amount("spilled_l", "l", "that has run over rims"),
    state::amount("faults", "", "ticks in which a formula divided by zero, or had no finite result"),
};

}  // namespace

std::vector<OwnValue> network_values(const state::ComponentDescription& component) {
  std::vector<OwnValue> out;
  for (const PartValue& value : part_values()) {
    const auto* texts = component.written<std::vector<std::string>>(std::string(value.list));
    if (texts == nullptr) continue;
    for (const std::string& text : *texts)
      out.push_back({std::string(part_name(text)) + std::string(value.ending), std::string(value.unit)});
  }
  return out;
}

const MachineKind& water_network_kind() {
  static const MachineKind kKind{{"machine.water_network", "Vessels, pipes, valves, siphons, shut-in air and floats",
                                  kNetworkParameters, kNetworkValues},
                                 make_water_network};
  return kKind;
}

}  // namespace mechane::machines
