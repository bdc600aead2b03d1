#include "server/agents/agent_set.hpp"

#include <algorithm>

#include "server/agents/agent.hpp"
#include "server/agents/event_graph.hpp"
#include "server/agents/progress.hpp"
#include "server/agents/quantities.hpp"
#include "server/agents/touches.hpp"

namespace mechane::agents {

struct AgentSet::Impl {
  const state::WorldDescription* description = nullptr;
  bool changes_surfaces = false;  // has agents that write what bodies feel like
  std::vector<std::unique_ptr<Agent>> agents;
  std::vector<std::size_t> order;  // those that switch others first, then as in the description
  std::vector<state::Coupling> couplings;
  EventGraph events;
  Touches touches;
  ProgressRules progress;
  Quantities quantities;

  /// True when an agent that is on used the click.
  [[nodiscard]] bool click(state::WorldState& state, std::size_t body) const noexcept {
    if (body >= state.bodies.size()) return false;
    for (std::size_t i = 0; i < agents.size(); ++i) {
      if (state.agent_enabled[i] != 0 && agents[i]->click(state, BodyId(body))) return true;
    }
    return false;
  }
};

AgentSet::AgentSet(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
AgentSet::~AgentSet() = default;

Expected<std::unique_ptr<AgentSet>> AgentSet::create(const state::WorldDescription& description,
                                                     state::MemoryLayout& layout) {
  auto impl = std::make_unique<Impl>();
  impl->description = &description;
  impl->changes_surfaces =
      std::ranges::any_of(description.agents, [](const auto& agent) { return agent.type == surface_kind().type.name; });
  for (std::size_t i = 0; i < description.agents.size(); ++i) {
    auto agent = state::make_component(kinds(), "agent", description, description.agents, AgentId(i), layout);
    if (!agent) return tl::unexpected(agent.error());
    impl->agents.push_back(std::move(*agent));
  }
  for (auto& agent : impl->agents) {
    if (auto linked = agent->link(layout); !linked) return tl::unexpected(linked.error());
  }
  impl->couplings = layout.couplings();
  for (const bool first : {true, false}) {
    for (std::size_t i = 0; i < impl->agents.size(); ++i) {
      if (impl->agents[i]->switches_others() == first) impl->order.push_back(i);
    }
  }
  impl->events = EventGraph(description, layout);
  impl->touches = Touches(description, layout);
  auto progress = ProgressRules::create(description, layout);
  if (!progress) return tl::unexpected(progress.error());
  impl->progress = std::move(*progress);
  impl->progress.remember_start(layout);
  auto quantities = Quantities::create(description, layout);
  if (!quantities) return tl::unexpected(quantities.error());
  impl->quantities = std::move(*quantities);
  return std::unique_ptr<AgentSet>(new AgentSet(std::move(impl)));
}

void AgentSet::start(state::WorldState& state) const noexcept {
  state.couplings = impl_->couplings;
  impl_->progress.start(state);
  impl_->quantities.update(state);
}

void AgentSet::run(state::WorldState& state, std::span<const state::Command> commands, double dt_s) const noexcept {
  for (const state::Command& command : commands) {
    const bool done = command.kind == state::CommandKind::click ? impl_->click(state, command.argument)
                                                                : impl_->progress.run_command(state, command);
    state.emit(done ? state::EventKind::command_done : state::EventKind::command_refused, 0xffffffffu, 0xffffffffu,
               static_cast<double>(command.id));
  }
  // Loads from before the activity began do not count.
  if (!commands.empty() && state.progress.activity_tick == state.tick) {
    for (state::Coupling& coupling : state.couplings)
      coupling.forget_forces();
  }
  for (std::size_t b = 0; impl_->changes_surfaces && b < state.bodies.size(); ++b)
    state.bodies[b].haptic = impl_->description->bodies[b].haptic;
  impl_->events.run(state, dt_s);
  for (const std::size_t i : impl_->order)
    impl_->agents[i]->run(state, state.agent_enabled[i] != 0, dt_s);
  impl_->touches.run(state, dt_s);
  impl_->quantities.update(state);
  impl_->progress.run_triggers(state, dt_s);
}

}  // namespace mechane::agents
