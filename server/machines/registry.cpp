#include "server/machines/registry.hpp"

#include <array>

#include "server/machines/machine.hpp"

namespace mechane::machines {
namespace {

std::array<const MachineKind*, 7> kinds() {
  return {&screw_pump_kind(), &force_pump_kind(),   &torsion_spring_kind(), &bow_kind(),
          &projectile_kind(), &steam_sphere_kind(), &pebble_counter_kind()};
}

}  // namespace

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = state::types_of(kinds());
  return kTypes;
}

const MachineKind* find_kind(std::string_view type) {
  return state::find_kind_in(kinds(), type);
}

}  // namespace mechane::machines
