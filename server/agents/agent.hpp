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

  /// Somebody clicked on a body, before this tick's run(). True when the agent took it. Allocates nothing.
  virtual bool click(state::WorldState& state, BodyId body) const noexcept;

  /// One tick, whether the agent is switched on or off. Allocates nothing.
  virtual void run(state::WorldState& state, bool enabled, double dt_s) const noexcept = 0;

  /// Whether it switches other agents: such run first in a tick, so that what they say holds in it.
  [[nodiscard]] virtual bool switches_others() const noexcept { return false; }
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
  /// A coupling of the component's: its index into WorldState::couplings.
  [[nodiscard]] std::size_t coupling(const state::Coupling& coupling) const {
    return layout.add_coupling(component.name, coupling);
  }
  /// A real force for one that is felt: couplings bear felt forces, scenarios speak of real ones.
  [[nodiscard]] double real_per_felt() const { return description.effort_scale > 0 ? 1 / description.effort_scale : 1; }
  [[nodiscard]] const state::ComponentDescription& agent(AgentId other) const {
    return description.agents[other.index()];
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
[[nodiscard]] const AgentKind& slider_kind();
[[nodiscard]] const AgentKind& ball_kind();
[[nodiscard]] const AgentKind& fixed_kind();
[[nodiscard]] const AgentKind& screw_kind();
[[nodiscard]] const AgentKind& gear_kind();
[[nodiscard]] const AgentKind& worm_kind();
[[nodiscard]] const AgentKind& intermittent_gear_kind();
[[nodiscard]] const AgentKind& ratchet_kind();
[[nodiscard]] const AgentKind& rope_kind();
[[nodiscard]] const AgentKind& breakable_kind();
[[nodiscard]] const AgentKind& pulled_kind();
[[nodiscard]] const AgentKind& pushed_kind();
[[nodiscard]] const AgentKind& fired_kind();
[[nodiscard]] const AgentKind& lit_kind();
[[nodiscard]] const AgentKind& assembled_kind();
[[nodiscard]] const AgentKind& dwell_kind();
[[nodiscard]] const AgentKind& point_kind();
[[nodiscard]] const AgentKind& idle_kind();

/// Null where no type has this name.
[[nodiscard]] const AgentKind* find_kind(std::string_view type);

/// Ends a user's grasp, if there is one, and says so with an event.
void let_go(state::WorldState& state, std::size_t user) noexcept;

}  // namespace mechane::agents
