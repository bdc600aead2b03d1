// simulation.turned: counts the turns of a hinge while it is on.
#include <cmath>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

class Turned final : public Agent {
 public:
  explicit Turned(const Build& build)
      : id_(build.id),
        joint_(build.parameters.joint("joint")),
        turns_per_event_(build.parameters.number("perTurns")),
        turns_(build.slot("turns")),
        most_(build.slot("most")),
        from_rad_(build.slot("from")),
        on_(build.slot("on")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const double position = state[joint_].position;
    if (enabled && state.memory[on_] == 0) {
      state.memory[from_rad_] = position;
      state.memory[most_] = 0;
    }
    state.memory[on_] = enabled ? 1 : 0;
    if (!enabled) return;
    const double turns = (position - state.memory[from_rad_]) / (2 * kPi);
    state.memory[turns_] = turns;
    const double whole = std::floor(std::abs(turns) / turns_per_event_);
    if (whole <= state.memory[most_]) return;
    state.memory[most_] = whole;
    state.emit(state::EventKind::turned, static_cast<std::uint32_t>(id_.index()), 0xffffffffu,
               std::trunc(turns + std::copysign(1e-9, turns)));
  }

 private:
  AgentId id_;
  JointId joint_;
  double turns_per_event_;
  std::size_t turns_;
  std::size_t most_;      // events so far
  std::size_t from_rad_;  // the joint's position when the agent was switched on
  std::size_t on_;
};

Expected<std::unique_ptr<Agent>> make_turned(const Build& build) {
  if (auto joint = build.joint("joint", state::JointKind::hinge); !joint) return tl::unexpected(joint.error());
  return std::make_unique<Turned>(build);
}

constexpr state::ParameterType kTurnedParameters[] = {
    {.name = "joint",
     .kind = state::ParameterKind::text,
     .summary = "the hinge whose turns are counted",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "perTurns",
     .summary = "an event each time that it has turned this far, either way",
     .default_value = 1,
     .min = 0.01,
     .max = 1e6},
};
constexpr state::ValueType kTurnedValues[] = {{"turns", "", "turned since the agent was switched on, signed"}};

}  // namespace

const AgentKind& turned_kind() {
  static const AgentKind kKind{{"simulation.turned", "Counts the turns of a hinge", kTurnedParameters, kTurnedValues},
                               make_turned};
  return kKind;
}

}  // namespace mechane::agents
