#include "server/machines/registry.hpp"

#include <array>

#include "server/machines/machine.hpp"

namespace mechane::machines {
namespace {

std::array<const MachineKind*, 1> kinds() {
  return {&screw_pump_kind()};
}

std::vector<state::ComponentType> collect_types() {
  std::vector<state::ComponentType> types;
  for (const MachineKind* kind : kinds())
    types.push_back(kind->type);
  return types;
}

}  // namespace

std::span<const state::ComponentType> registry() {
  static const std::vector<state::ComponentType> kTypes = collect_types();
  return kTypes;
}

const MachineKind* find_kind(std::string_view type) {
  for (const MachineKind* kind : kinds()) {
    if (kind->type.name == type) return kind;
  }
  return nullptr;
}

}  // namespace mechane::machines
