// What a machine is to the set that runs it, and how one is made. Inside this room only.
#pragma once

#include <memory>
#include <span>

#include "server/base/error.hpp"
#include "server/state/component_build.hpp"
#include "server/state/world_state.hpp"

namespace mechane::machines {

/// One machine. Immutable once linked: what it remembers lies in slots of WorldState::memory.
class Machine {
 public:
  virtual ~Machine() = default;

  /// Called once, when every agent and machine has its slots: for those that read another's value.
  [[nodiscard]] virtual Expected<void> link(const state::MemoryLayout& layout);

  /// One tick. Allocates nothing.
  virtual void run(state::WorldState& state, double dt_s) const noexcept = 0;
};

/// What a maker gets.
struct Build : state::ComponentBuild {
  MachineId id;

  /// The parameter effortScale, or the world's where the author wrote none.
  [[nodiscard]] double effort_scale() const {
    return parameters.given("effortScale") ? parameters.number("effortScale") : description.effort_scale;
  }
};

/// The parameter that Build::effort_scale() reads.
[[nodiscard]] constexpr state::ParameterType effort_scale_parameter(std::string_view summary) {
  return {.name = "effortScale", .summary = summary, .default_value = 1, .min = 0, .max = 1};
}

using MachineKind = state::ComponentKind<Machine, Build>;

/// One file each.
[[nodiscard]] const MachineKind& screw_pump_kind();
[[nodiscard]] const MachineKind& force_pump_kind();
[[nodiscard]] const MachineKind& torsion_spring_kind();
[[nodiscard]] const MachineKind& bow_kind();
[[nodiscard]] const MachineKind& projectile_kind();
[[nodiscard]] const MachineKind& steam_sphere_kind();
[[nodiscard]] const MachineKind& pebble_counter_kind();
[[nodiscard]] const MachineKind& formula_kind();
[[nodiscard]] const MachineKind& water_network_kind();

/// All of them.
[[nodiscard]] std::span<const MachineKind* const> kinds();

}  // namespace mechane::machines
