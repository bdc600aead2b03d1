#include "server/machines/energy_store.hpp"

#include <algorithm>

namespace mechane::machines {
namespace {

// An offer stays open this long, because agents switch off the joint that holds the missile a tick or two after the trigger.
constexpr double kOpen_s = 0.05;
constexpr const char* kOffered = "store.offered_j";
constexpr const char* kTaken = "store.taken_j";

}  // namespace

EnergyStore::EnergyStore(const Build& build, QuantityId release)
    : release_(release),
      was_released_(build.slot("store.was_released", 1)),  // a release that is up at the start does not count as rising
      offered_j_(build.slot(kOffered)),
      left_s_(build.slot("store.left_s")),
      taken_j_(build.slot(kTaken)) {}

bool EnergyStore::released(state::WorldState& state) const noexcept {
  if (!release_) return false;
  const bool now = state.quantities[release_.index()] > 0.5;
  const bool rises = now && state.memory[was_released_] == 0;
  state.memory[was_released_] = now ? 1 : 0;
  return rises;
}

void EnergyStore::offer(state::WorldState& state, double energy_j) const noexcept {
  state.memory[offered_j_] = energy_j;
  state.memory[left_s_] = kOpen_s;
  state.memory[taken_j_] = 0;
}

bool EnergyStore::wait(state::WorldState& state, double dt_s) const noexcept {
  double& left_s = state.memory[left_s_];
  left_s = std::max(0.0, left_s - dt_s);
  if (left_s == 0) state.memory[offered_j_] = 0;
  return state.memory[offered_j_] > 0;
}

Expected<EnergyOffer> EnergyOffer::find(const Build& build, std::string_view parameter) {
  const std::string name = build.parameters.text(parameter);
  const MachineId machine = build.description.find_machine(name);
  if (machine.index() > build.id.index())
    return fail(ErrorCode::conflict, "the machine '" + name + "' is written after this one", build.place(parameter),
                "write it before this one");
  const state::MemorySlot* offered = build.layout.find(name + "." + kOffered);
  const state::MemorySlot* taken = build.layout.find(name + "." + kTaken);
  if (offered == nullptr || taken == nullptr) {
    return fail(
        ErrorCode::invalid_value,
        "the machine '" + name + "' is a " + build.description.machines[machine.index()].type + ", which has no spring",
        build.place(parameter), "name a machine.torsion_spring or a machine.bow");
  }
  EnergyOffer out;
  out.offered_j_ = offered->index;
  out.taken_j_ = taken->index;
  return out;
}

void EnergyOffer::take(state::WorldState& state, double energy_j) const noexcept {
  state.memory[offered_j_] = 0;
  state.memory[taken_j_] = energy_j;
}

}  // namespace mechane::machines
