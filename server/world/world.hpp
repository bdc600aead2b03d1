// One running scenario: its state, and the parts that a tick calls.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "server/agents/agent_set.hpp"
#include "server/base/error.hpp"
#include "server/dynamics/dynamics_world.hpp"
#include "server/haptics/hand_model.hpp"
#include "server/haptics/render_forces.hpp"
#include "server/machines/machine_set.hpp"
#include "server/state/world_state.hpp"

namespace mechane::world {

/// What all worlds of a server share.
struct WorldConfig {
  std::shared_ptr<const haptics::HandModel> hand;  ///< made once: its shapes are the same in every world
  haptics::ForceConfig force;
};

/// All parts of a world. Made on the main thread, then stepped by one loop thread at a time; it starts no thread of its own.
class World {
 public:
  /// A world at the beginning of its scenario. Errors: those of agents, machines, bodies and joints that cannot work as described.
  [[nodiscard]] static Expected<std::unique_ptr<World>> create(
      const std::shared_ptr<const state::WorldDescription>& description, const WorldConfig& config);
  /// A world where a snapshot of the same scenario left it. Its hands come back as new ones and hold nothing, so that there is no force
  /// before there is a hand.
  [[nodiscard]] static Expected<std::unique_ptr<World>> resume(
      const std::shared_ptr<const state::WorldDescription>& description, const WorldConfig& config,
      std::span<const std::byte> snapshot);

  // The parts, in the order that a tick uses them. step() is the only caller.
  const std::shared_ptr<const state::WorldDescription> description;
  state::WorldState state;
  const std::unique_ptr<agents::AgentSet> agents;
  const std::unique_ptr<machines::MachineSet> machines;
  const std::shared_ptr<const haptics::HandModel> hand;
  const haptics::ForceRenderer forces;
  std::unique_ptr<dynamics::DynamicsWorld> dynamics;

 private:
  World(std::shared_ptr<const state::WorldDescription> of, std::unique_ptr<agents::AgentSet> its_agents,
        std::unique_ptr<machines::MachineSet> its_machines, std::shared_ptr<const haptics::HandModel> its_hand,
        haptics::ForceRenderer its_forces);
};

}  // namespace mechane::world
