// simulation.pulled and simulation.pushed: a hand pulls a body that it holds, or pushes one that it touches, hard or far enough.
#include "server/agents/hand_effort.hpp"

namespace mechane::agents {
namespace {

class Moved final : public Agent {
 public:
  Moved(const Build& build, const HandEffort& effort, const std::string& value, state::EventKind event)
      : id_(build.id), effort_(effort), event_(event), moved_(build.slot(value)) {}

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const bool now = effort_.run(state, enabled, dt_s);
    if (now && state.memory[moved_] == 0) {
      state.emit(event_, static_cast<std::uint32_t>(id_.index()), static_cast<std::uint32_t>(effort_.body().index()));
    }
    state.memory[moved_] = now ? 1 : 0;
  }

 private:
  AgentId id_;
  HandEffort effort_;
  state::EventKind event_;
  std::size_t moved_;
};

Expected<std::unique_ptr<Agent>> make_pulled(const Build& build) {
  auto effort = HandEffort::create(build, Effort::pull);
  if (!effort) return tl::unexpected(effort.error());
  return std::make_unique<Moved>(build, *effort, "pulled", state::EventKind::pulled);
}

Expected<std::unique_ptr<Agent>> make_pushed(const Build& build) {
  auto effort = HandEffort::create(build, Effort::push);
  if (!effort) return tl::unexpected(effort.error());
  return std::make_unique<Moved>(build, *effort, "pushed", state::EventKind::pushed);
}

constexpr state::ParameterType kMovedParameters[] = {kEffortBody,  kEffortForce,   kEffortTravel, kEffortAxis,
                                                     kEffortJoint, kEffortReverse, kEffortTime};
constexpr state::ValueType kForce{"force", "N", "of the hand on the body, along the axis, as felt"};
constexpr state::ValueType kTravel{"travel", "m",
                                   "how far the body went with the hand; rad where the joint is a hinge"};
constexpr state::ValueType kPulledValues[] = {state::yes_or_no("pulled", "1 while a hand pulls it hard or far enough"),
                                              kForce, kTravel};
constexpr state::ValueType kPushedValues[] = {state::yes_or_no("pushed", "1 while a hand pushes it hard or far enough"),
                                              kForce, kTravel};

}  // namespace

const AgentKind& pulled_kind() {
  static const AgentKind kKind{
      {"simulation.pulled", "Says when a hand pulls a body hard or far enough", kMovedParameters, kPulledValues},
      make_pulled};
  return kKind;
}

const AgentKind& pushed_kind() {
  static const AgentKind kKind{
      {"simulation.pushed", "Says when a hand pushes a body hard or far enough", kMovedParameters, kPushedValues},
      make_pushed};
  return kKind;
}

}  // namespace mechane::agents
