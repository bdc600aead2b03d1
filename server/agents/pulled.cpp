// simulation.pulled: a hand that holds a body pulls it hard or far enough.
#include "server/agents/hand_effort.hpp"

namespace mechane::agents {
namespace {

class Pulled final : public Agent {
 public:
  Pulled(const Build& build, const HandEffort& effort)
      : id_(build.id), effort_(effort), pulled_(build.slot("pulled")) {}

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const bool now = effort_.run(state, enabled, dt_s);
    if (now && state.memory[pulled_] == 0) {
      state.emit(state::EventKind::pulled, static_cast<std::uint32_t>(id_.index()),
                 static_cast<std::uint32_t>(effort_.body().index()));
    }
    state.memory[pulled_] = now ? 1 : 0;
  }

 private:
  AgentId id_;
  HandEffort effort_;
  std::size_t pulled_;
};

Expected<std::unique_ptr<Agent>> make_pulled(const Build& build) {
  auto effort = HandEffort::create(build, Effort::pull);
  if (!effort) return tl::unexpected(effort.error());
  return std::make_unique<Pulled>(build, *effort);
}

constexpr state::ParameterType kPulledParameters[] = {kEffortBody,  kEffortForce,   kEffortTravel, kEffortAxis,
                                                      kEffortJoint, kEffortReverse, kEffortTime};
constexpr state::ValueType kPulledValues[] = {
    state::yes_or_no("pulled", "1 while a hand pulls it hard or far enough"),
    {"force", "N", "of the hand on the body, along the axis, as felt"},
    {"travel", "m", "how far the body went with the hand; rad where the joint is a hinge"},
};

}  // namespace

const AgentKind& pulled_kind() {
  static const AgentKind kKind{
      {"simulation.pulled", "Says when a hand pulls a body hard or far enough", kPulledParameters, kPulledValues},
      make_pulled};
  return kKind;
}

}  // namespace mechane::agents
