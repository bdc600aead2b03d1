#include "server/machines/registry.hpp"

#include "server/machines/machine.hpp"

namespace mechane::machines {

std::span<const MachineKind* const> kinds() {
  static const MachineKind* const kKinds[] = {&screw_pump_kind(),    &force_pump_kind(), &torsion_spring_kind(),
                                              &bow_kind(),           &projectile_kind(), &steam_sphere_kind(),
                                              &pebble_counter_kind()};
  return kKinds;
}

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = state::types_of(kinds());
  return kTypes;
}

}  // namespace mechane::machines
