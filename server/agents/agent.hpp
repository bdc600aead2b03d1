// What an agent is to the set that runs it, and how one is made. Inside this room only.
#pragma once

#include <memory>
#include <span>

#include "server/base/error.hpp"
#include "server/state/component_build.hpp"
#include "server/state/world_state.hpp"

namespace mechane::agents {

/// One agent. Immutable once linked: what it remembers lies in slots of WorldState::memory.
class Agent {
 public:
  virtual ~Agent() = default;

  /// Called once, when every agent and machine has its slots: for those that read another's value.
  [[nodiscard]] virtual Expected<void> link(const state::MemoryLayout& layout);

  /// Somebody clicked on a body, before this tick's run(). True when the agent used the click. Allocates nothing.
  virtual bool click(state::WorldState& state, BodyId body) const noexcept;

  /// One tick, whether the agent is switched on or off. Allocates nothing.
  virtual void run(state::WorldState& state, bool enabled, double dt_s) const noexcept = 0;

  /// Whether it switches other agents. Such agents run first in a tick, so that their switches hold within it.
  [[nodiscard]] virtual bool switches_others() const noexcept { return false; }
};

/// What a maker gets.
struct Build : state::ComponentBuild {
  AgentId id;

  /// A new coupling: its index into WorldState::couplings.
  [[nodiscard]] std::size_t coupling(const state::Coupling& coupling) const {
    return layout.add_coupling(component.name, coupling);
  }
  /// Real over felt force: couplings bear felt forces, scenarios speak of real ones.
  [[nodiscard]] double real_per_felt() const { return description.effort_scale > 0 ? 1 / description.effort_scale : 1; }
};

using AgentKind = state::ComponentKind<Agent, Build>;

/// One file each; what is nearly alike shares one.
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
[[nodiscard]] const AgentKind& surface_kind();

/// All of them.
[[nodiscard]] std::span<const AgentKind* const> kinds();

/// Ends a user's grasp, if there is one, and emits `released`.
void let_go(state::WorldState& state, std::size_t user) noexcept;

}  // namespace mechane::agents
