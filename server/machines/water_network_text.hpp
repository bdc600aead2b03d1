// A water network as its author wrote it, and as the tick runs it: from "TANK: area 0.02 m2, height 0.3 m" to numbers and programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/machines/expression.hpp"
#include "server/machines/machine.hpp"
#include "server/machines/unit.hpp"
#include "server/machines/water_flow.hpp"

namespace mechane::machines {

/// Where the values of a network lie in the machine's own memory, SI. Of a list, the first one's; the others follow. `vent`, `open` and
/// `wanted` are what formulas say in this tick.
struct NetworkSlots {
  std::size_t faults = 0;
  std::size_t supplied = 0, delivered = 0, spilled = 0;
  std::size_t water = 0, level = 0, pressure = 0, overflow = 0, vent = 0;  ///< of vessels
  std::size_t air = 0;
  std::size_t flow = 0, primed = 0, open = 0;  ///< of pipes
  std::size_t poured = 0, wanted = 0;          ///< of feeds
  std::size_t lift = 0;                        ///< of floats
};

/// A value that each part of a list offers: "TANK_level".
struct PartValue {
  std::string_view list;    ///< the parameter that has the part
  std::string_view ending;  ///< after the part's name
  std::string_view unit;    ///< that it is shown in
  std::size_t NetworkSlots::*first = nullptr;
};
[[nodiscard]] std::span<const PartValue> part_values();
/// The first word, which a colon should follow; empty where there is none.
[[nodiscard]] std::string_view part_name(std::string_view text);

/// One value as it is shown.
struct ShownValue {
  std::size_t si = 0;
  std::size_t shown = 0;
  double factor = 1;
};

struct VesselLoad {
  BodyId body;           ///< whose weight the water adds to; none: no body's
  std::vector<Op> vent;  ///< above one half its air is that of the room
};
struct Feed {
  std::size_t into = 0;
  std::vector<Op> flow;  ///< m^3/s
};
/// An upright prism that swims: its underside is `bottom_m` over the body's origin.
struct Float {
  std::size_t in = 0;
  BodyId body;
  double area_m2 = 0;
  double height_m = 0;
  double bottom_m = 0;
  double drag_n_s_m = 0;  ///< quite under water
};

struct NetworkSettings {
  std::vector<Vessel> vessels;
  std::vector<VesselLoad> loads;  ///< of the vessels
  std::vector<Pipe> pipes;
  std::vector<std::vector<Op>> open;  ///< of the pipes; empty: always open
  std::vector<Feed> feeds;
  std::vector<Float> floats;
  std::size_t airs = 0;
  NetworkSlots slots;
  std::vector<ShownValue> shown;
  std::vector<double> memory;  ///< as it is at the start
  std::vector<std::string> names;
  double time_scale = 1;
  double limit_n = 0;
};

/// Errors: missing, invalid_value, unknown_name, duplicate, conflict (units; heights; a pipe whose ends are in one vessel), too_large; each
/// with the part, its line and what to write.
[[nodiscard]] Expected<NetworkSettings> read_network(const Build& build);

}  // namespace mechane::machines
