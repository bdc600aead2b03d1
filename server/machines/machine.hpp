// What a machine is to the set that runs it, and how one is made. Inside this room only.
#pragma once

#include <memory>

#include "server/base/error.hpp"
#include "server/state/component_type.hpp"
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

/// What a maker gets. Parameters are checked against the type already.
struct Build {
  const state::WorldDescription& description;
  const state::ComponentDescription& component;
  const state::Parameters& parameters;
  MachineId id;
  state::MemoryLayout& layout;

  [[nodiscard]] std::size_t slot(const std::string& value, double initial = 0) const {
    return layout.add(component.name, value, initial);
  }
  /// The parameter effortScale, or the world's where the author wrote none.
  [[nodiscard]] double effort_scale() const {
    return parameters.given("effortScale") ? parameters.number("effortScale") : description.effort_scale;
  }
  [[nodiscard]] const state::ComponentDescription& agent(AgentId other) const {
    return description.agents[other.index()];
  }
};

/// The joint that `parameter` names, which must turn (a hinge) or slide (a slider). The error says which it does not do.
[[nodiscard]] Expected<JointId> read_joint(const Build& build, const std::string& parameter, state::JointKind kind);

struct MachineKind {
  state::ComponentType type;
  Expected<std::unique_ptr<Machine>> (*make)(const Build& build);
};

/// One file each.
[[nodiscard]] const MachineKind& screw_pump_kind();
[[nodiscard]] const MachineKind& force_pump_kind();
[[nodiscard]] const MachineKind& torsion_spring_kind();
[[nodiscard]] const MachineKind& bow_kind();
[[nodiscard]] const MachineKind& projectile_kind();
[[nodiscard]] const MachineKind& steam_sphere_kind();
[[nodiscard]] const MachineKind& pebble_counter_kind();

/// Null where no type has this name.
[[nodiscard]] const MachineKind* find_kind(std::string_view type);

}  // namespace mechane::machines
