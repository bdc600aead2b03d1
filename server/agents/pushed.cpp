// simulation.pushed: a hand that touches a body pushes it hard or far enough.
#include "server/agents/hand_effort.hpp"

namespace mechane::agents {
namespace {

class Pushed final : public Agent {
 public:
  Pushed(const Build& build, const HandEffort& effort)
      : id_(build.id), effort_(effort), pushed_(build.slot("pushed")) {}

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const bool now = effort_.run(state, enabled, dt_s);
    if (now && state.memory[pushed_] == 0) {
      state.emit(state::EventKind::pushed, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(effort_.body().index()));
    }
    state.memory[pushed_] = now ? 1 : 0;
  }

 private:
  AgentId id_;
  HandEffort effort_;
  std::size_t pushed_;
};

Expected<std::unique_ptr<Agent>> make_pushed(const Build& build) {
  auto effort = HandEffort::create(build, Effort::push);
  if (!effort) return tl::unexpected(effort.error());
  return std::make_unique<Pushed>(build, *effort);
}

constexpr state::ParameterType kPushedParameters[] = {kEffortBody,  kEffortForce,   kEffortTravel, kEffortAxis,
                                                      kEffortJoint, kEffortReverse, kEffortTime};
constexpr state::ValueType kPushedValues[] = {
    state::yes_or_no("pushed", "1 while a hand pushes it hard or far enough"),
    {"force", "N", "of the hand on the body, along the axis, as felt"},
    {"travel", "m", "how far the body went with the hand; rad where the joint is a hinge"},
};

}  // namespace

const AgentKind& pushed_kind() {
  static const AgentKind kKind{
      {"simulation.pushed", "Says when a hand pushes a body hard or far enough", kPushedParameters, kPushedValues},
      make_pushed};
  return kKind;
}

}  // namespace mechane::agents
