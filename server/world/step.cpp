#include "server/world/step.hpp"

#include "server/haptics/contacts.hpp"
#include "server/haptics/near_surfaces.hpp"
#include "server/world/inputs.hpp"

namespace mechane::world {

void feel(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept {
  const state::WorldDescription& description = *world.description;
  state::WorldState& state = world.state;
  timer.start();

  begin_tick(state);
  take_inputs(inputs, state);
  timer.ended(Phase::take_inputs);

  move_hands(*world.hand, state);
  timer.ended(Phase::move_hands);

  haptics::find_contacts(description, *world.hand, state);
  haptics::find_near_surfaces(description, *world.hand, state);
  timer.ended(Phase::find_contacts);

  world.agents->run(state, commands_of(inputs), kTickSeconds);
  timer.ended(Phase::run_agents);

  world.forces.run(description, *world.hand, state);
  publisher.publish_forces(state);
  timer.ended(Phase::render_forces);
}

void move(World& world, Publisher& publisher, PhaseTimer& timer) noexcept {
  state::WorldState& state = world.state;
  timer.start();

  world.machines->run(state, kTickSeconds);
  timer.ended(Phase::run_machines);

  world.dynamics->step(state, kTickSeconds);
  timer.ended(Phase::step_dynamics);

  publisher.publish(state);
  timer.ended(Phase::publish);
}

void step(World& world, const state::TickInputs& inputs, Publisher& publisher, PhaseTimer& timer) noexcept {
  feel(world, inputs, publisher, timer);
  move(world, publisher, timer);
}

}  // namespace mechane::world
