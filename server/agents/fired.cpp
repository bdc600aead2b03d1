// simulation.fired: a trigger that, when a hand pulls it, lets go of what it held, once.
#include "server/agents/hand_effort.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Fired final : public Agent {
 public:
  Fired(const Build& build, const HandEffort& effort, std::vector<AgentId> releases)
      : id_(build.id), effort_(effort), releases_(std::move(releases)), fired_(build.slot("fired")) {}

  [[nodiscard]] bool switches_others() const noexcept override { return true; }

  /// Fires once. It is cocked again when it is switched off and on, or when the activity begins anew.
  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const bool now = effort_.run(state, enabled, dt_s);
    if (!enabled) state.memory[fired_] = 0;
    if (!now || state.memory[fired_] != 0) return;
    state.memory[fired_] = 1;
    for (const AgentId agent : releases_)
      state.agent_enabled[agent.index()] = 0;
    state.emit(state::EventKind::fired, static_cast<std::uint32_t>(id_.index()),
               static_cast<std::uint32_t>(effort_.body().index()));
  }

 private:
  AgentId id_;
  HandEffort effort_;
  std::vector<AgentId> releases_;
  std::size_t fired_;
};

Expected<std::unique_ptr<Agent>> make_fired(const Build& build) {
  auto effort = HandEffort::create(build, Effort::pull);
  if (!effort) return tl::unexpected(effort.error());
  std::vector<AgentId> releases;
  for (const std::string& name : build.parameters.texts("releases")) {
    releases.push_back(build.description.find_agent(name));
    if (releases.back() == build.id)
      return fail(ErrorCode::conflict, "'releases' names the agent itself", build.place("releases"),
                  "name the agent that holds the load: a geometry.fixed or a geometry.rope");
  }
  return std::make_unique<Fired>(build, *effort, std::move(releases));
}

constexpr state::ParameterType kFiredParameters[] = {
    kEffortBody,
    kEffortForce,
    kEffortTravel,
    kEffortAxis,
    kEffortJoint,
    kEffortReverse,
    kEffortTime,
    {.name = "releases",
     .kind = ParameterKind::texts,
     .summary = "agents that it switches off: a tie, a ratchet, a rope",
     .reference = state::Reference::agent}};
constexpr state::ValueType kFiredValues[] = {
    state::yes_or_no("fired", "1 once it has fired"),
    {"force", "N", "of the hand on the trigger, along the axis, as felt"},
    {"travel", "m", "how far the trigger went with the hand; rad where the joint is a hinge"},
};

}  // namespace

const AgentKind& fired_kind() {
  static const AgentKind kKind{
      {"simulation.fired", "A trigger lets go of what it held when a hand pulls it", kFiredParameters, kFiredValues},
      make_fired};
  return kKind;
}

}  // namespace mechane::agents
