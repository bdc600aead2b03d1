#include "server/world/world.hpp"

#include <utility>

#include "server/base/assert.hpp"
#include "server/state/snapshot.hpp"

namespace mechane::world {

World::World(std::shared_ptr<const state::WorldDescription> of, std::unique_ptr<agents::AgentSet> its_agents,
             std::unique_ptr<machines::MachineSet> its_machines, std::shared_ptr<const haptics::HandModel> its_hand,
             haptics::ForceRenderer its_forces)
    : description(std::move(of)),
      state(*description),
      agents(std::move(its_agents)),
      machines(std::move(its_machines)),
      hand(std::move(its_hand)),
      forces(its_forces) {}

Expected<std::unique_ptr<World>> World::create(const std::shared_ptr<const state::WorldDescription>& description,
                                               const WorldConfig& config) {
  state::MemoryLayout layout;
  auto machines = machines::MachineSet::create(*description, layout);
  if (!machines) return tl::unexpected(machines.error());
  auto agents = agents::AgentSet::create(*description, layout);
  if (!agents) return tl::unexpected(agents.error());
  if (auto linked = (*machines)->link(layout); !linked) return tl::unexpected(linked.error());
  MECHANE_ASSERT(config.hand != nullptr);
  auto forces = haptics::ForceRenderer::create(config.force);
  if (!forces) return tl::unexpected(forces.error());
  std::unique_ptr<World> world(new World(description, std::move(*agents), std::move(*machines), config.hand, *forces));
  world->state.memory = layout.initial();
  world->agents->start(world->state);
  world->forces.start(world->state);
  auto dynamics = dynamics::DynamicsWorld::create(*description, world->state);
  if (!dynamics) return tl::unexpected(dynamics.error());
  world->dynamics = std::move(*dynamics);
  return world;
}

namespace {

/// Ids that index the description must lie inside it.
bool progress_in_range(const state::WorldDescription& description, const state::Progress& progress) {
  return (!progress.step || progress.step.index() < description.steps.size()) &&
         (!progress.activity || progress.activity.index() < description.activities.size());
}

}  // namespace

Expected<std::unique_ptr<World>> World::resume(const std::shared_ptr<const state::WorldDescription>& description,
                                               const WorldConfig& config, std::span<const std::byte> snapshot) {
  auto world = create(description, config);
  if (!world) return world;
  state::WorldState& state = (*world)->state;
  if (auto read = state::read_snapshot(snapshot, state); !read) return tl::unexpected(read.error());
  if (!progress_in_range(*description, state.progress)) {
    return fail(ErrorCode::conflict, "the snapshot is at a step that the scenario does not have", "snapshot",
                "delete it; the world then starts from the beginning");
  }
  // The hands were those of the server that stopped; they come back as new ones.
  for (state::UserState& user : state.users)
    user = state::UserState{};
  (*world)->forces.start(state);
  auto dynamics = dynamics::DynamicsWorld::create(*description, state);
  if (!dynamics) return tl::unexpected(dynamics.error());
  (*world)->dynamics = std::move(*dynamics);
  return world;
}

}  // namespace mechane::world
