// geometry.hinge: a joint's switch, friction and limits.
#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Hinge final : public Agent {
 public:
  Hinge(const Build& build, const JointSwitch& joint)
      : joint_(joint), angle_(build.slot("angle")), rate_(build.slot("rate")), turns_(build.slot("turns")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const state::JointState& joint = joint_.apply(state, enabled);
    state.memory[angle_] = joint.position;
    state.memory[rate_] = joint.velocity;
    state.memory[turns_] = joint.position / (2 * kPi);
  }

 private:
  JointSwitch joint_;
  std::size_t angle_;
  std::size_t rate_;
  std::size_t turns_;
};

Expected<std::unique_ptr<Agent>> make_hinge(const Build& build) {
  const state::Parameters& p = build.parameters;
  if (build.description.joints[p.joint("joint").index()].kind != state::JointKind::hinge)
    return fail("the joint '" + p.text("joint") + "' is not a hinge", state::component_place(build.component),
                "name a SingleAxisHingeJoint");
  auto joint = JointSwitch::create(build, state::JointKind::hinge, "SingleAxisHingeJoint",
                                   {"frictionTorque", "viscous", "minAngle", "maxAngle"});
  if (!joint) return tl::unexpected(joint.error());
  return std::make_unique<Hinge>(build, *joint);
}

constexpr state::ParameterType kHingeParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge that is on while this agent is",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "frictionTorque",
     .unit = "N m",
     .summary = "Coulomb friction of the real bearing; felt times the world's effort_scale",
     .min = 0,
     .max = 1e6},
    {.name = "viscous",
     .unit = "N m s/rad",
     .summary = "drag that grows with the rate; felt times the world's effort_scale",
     .min = 0,
     .max = 1e6},
    {.name = "minAngle",
     .unit = "rad",
     .summary = "lower stop; with maxAngle. Neither: the joint's own",
     .min = -1e4,
     .max = 1e4},
    {.name = "maxAngle", .unit = "rad", .summary = "upper stop; with minAngle", .min = -1e4, .max = 1e4},
};
constexpr state::ValueType kHingeValues[] = {
    {"angle", "rad", "of body2 against body1; counts on over whole turns"},
    {"rate", "rad/s", "how fast it turns"},
    {"turns", "", "the angle in turns"},
};

}  // namespace

const AgentKind& hinge_kind() {
  static const AgentKind kKind{
      {"geometry.hinge", "Ties two bodies by a hinge while it is on", kHingeParameters, kHingeValues}, make_hinge};
  return kKind;
}

}  // namespace mechane::agents
