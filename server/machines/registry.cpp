#include "server/machines/registry.hpp"

#include "server/machines/formula.hpp"
#include "server/machines/machine.hpp"
#include "server/machines/water_network.hpp"

namespace mechane::machines {

std::span<const MachineKind* const> kinds() {
  static const MachineKind* const kKinds[] = {
      &screw_pump_kind(),   &force_pump_kind(),     &torsion_spring_kind(), &bow_kind(),          &projectile_kind(),
      &steam_sphere_kind(), &pebble_counter_kind(), &formula_kind(),        &water_network_kind()};
  return kKinds;
}

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = state::types_of(kinds());
  return kTypes;
}

std::vector<OwnValue> own_values(const state::ComponentDescription& machine) {
  if (machine.type == formula_kind().type.name) return formula_values(machine);
  if (machine.type == water_network_kind().type.name) return network_values(machine);
  return {};
}

std::vector<MachineFault> check(const state::WorldDescription& description) {
  std::vector<MachineFault> faults;
  state::MemoryLayout layout;
  for (std::size_t i = 0; i < description.machines.size(); ++i) {
    const auto made =
        state::make_component(kinds(), "machine", description, description.machines, MachineId(i), layout);
    if (!made) faults.push_back({MachineId(i), made.error()});
  }
  return faults;
}

}  // namespace mechane::machines
