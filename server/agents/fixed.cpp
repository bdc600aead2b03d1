// geometry.fixed: two bodies move as one, as they stand when it is switched on.
#include "server/agents/pose_slots.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Fixed final : public Agent {
 public:
  explicit Fixed(const Build& build)
      : body1_(build.parameters.body("to")),
        body2_(build.parameters.body("body")),
        real_per_felt_(build.real_per_felt()),
        coupling_(build.coupling(tie(build))),
        on_(build.slot("on")),
        force_(build.slot("force")),
        torque_(build.slot("torque")),
        X_B1B2_(build, "held") {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    if (enabled && state.memory[on_] == 0) {
      const Pose X_WB1 = body1_ ? state[body1_].X_WB : Pose{};
      X_B1B2_.write(state, X_WB1.inverse() * state[body2_].X_WB);
    }
    state.memory[on_] = enabled ? 1 : 0;
    state::Coupling& tie = state.couplings[coupling_];
    tie.enabled = enabled;
    tie.X_B1B2 = X_B1B2_.read(state);
    state.memory[force_] = tie.force_n * real_per_felt_;
    state.memory[torque_] = tie.torque_nm * real_per_felt_;
  }

 private:
  [[nodiscard]] static state::Coupling tie(const Build& build) {
    state::Coupling tie;
    tie.kind = state::CouplingKind::fixed;
    tie.body1 = build.parameters.body("to");
    tie.body2 = build.parameters.body("body");
    return tie;
  }

  BodyId body1_;
  BodyId body2_;
  double real_per_felt_;
  std::size_t coupling_;
  std::size_t on_;
  std::size_t force_;
  std::size_t torque_;
  PoseSlots X_B1B2_;
};

Expected<std::unique_ptr<Agent>> make_fixed(const Build& build) {
  const BodyId body = build.parameters.body("body"), to = build.parameters.body("to");
  if (body == to)
    return fail(ErrorCode::conflict, "'body' and 'to' name the same body", build.place("to"),
                "name another body in 'to', or none for the world");
  if (build.description.bodies[body.index()].fixed)
    return fail(ErrorCode::conflict, "the body '" + build.parameters.text("body") + "' is fixed already",
                build.place("body"), "name a body that can move in 'body'");
  return std::make_unique<Fixed>(build);
}

constexpr state::ParameterType kFixedParameters[] = {
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "the body that is tied",
     .required = true,
     .reference = state::Reference::body},
    {.name = "to",
     .kind = ParameterKind::text,
     .summary = "the body that it is tied to; none: the world",
     .reference = state::Reference::body},
};
constexpr state::ValueType kFixedValues[] = {
    state::yes_or_no("on", "1 while it ties"),
    state::amount("force", "N", "what the tie bears: the real force"),
    state::amount("torque", "N m", "what it bears at the body's origin: the real torque"),
};

}  // namespace

const AgentKind& fixed_kind() {
  static const AgentKind kKind{{"geometry.fixed", "Two bodies move as one, as they stand when it is switched on",
                                kFixedParameters, kFixedValues},
                               make_fixed};
  return kKind;
}

}  // namespace mechane::agents
