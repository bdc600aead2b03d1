// What an agent is to the set that runs it, and how one is made. Inside this room only.
#pragma once

#include <memory>
#include <span>

#include "server/base/error.hpp"
#include "server/state/component_type.hpp"
#include "server/state/world_state.hpp"

namespace mechane::agents {

/// One agent. Immutable once linked: what it remembers lies in slots of WorldState::memory.
class Agent {
 public:
  virtual ~Agent() = default;

  /// Called once, when every agent and machine has its slots: for those that read another's value.
  [[nodiscard]] virtual Expected<void> link(const state::MemoryLayout& layout);

  /// One tick, whether the agent is switched on or off. Allocates nothing.
  virtual void run(state::WorldState& state, bool enabled, double dt_s) const noexcept = 0;
};

/// What a maker gets. Parameters are checked against the type already; the references live until the set is made, the description
/// as long as the set.
struct Build {
  const state::WorldDescription& description;
  const state::ComponentDescription& component;
  const state::Parameters& parameters;
  AgentId id;
  state::MemoryLayout& layout;

  /// A slot for a value that quantities may read, or that only the agent reads.
  [[nodiscard]] std::size_t slot(const std::string& value, double initial = 0) const {
    return layout.add(component.name, value, initial);
  }
};

struct AgentKind {
  state::ComponentType type;
  Expected<std::unique_ptr<Agent>> (*make)(const Build& build);
};

/// One file each.
[[nodiscard]] const AgentKind& hinge_kind();
[[nodiscard]] const AgentKind& snap_kind();
[[nodiscard]] const AgentKind& grasp_kind();
[[nodiscard]] const AgentKind& placed_kind();
[[nodiscard]] const AgentKind& turned_kind();

/// Null where no type has this name.
[[nodiscard]] const AgentKind* find_kind(std::string_view type);

/// Ends a user's grasp, if there is one, and says so with an event.
void let_go(state::WorldState& state, std::size_t user) noexcept;

}  // namespace mechane::agents
