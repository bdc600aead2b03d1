// geometry.screw: a hinge that goes along its axis as it turns, by the pitch of its thread.
#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Screw final : public Agent {
 public:
  Screw(const Build& build, const JointSwitch& joint)
      : joint_(joint),
        pitch_m_per_rad_(build.parameters.number("pitch") / (2 * kPi)),
        angle_(build.slot("angle")),
        rate_(build.slot("rate")),
        turns_(build.slot("turns")),
        travel_(build.slot("travel")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    state::JointState& joint = joint_.apply(state, enabled);
    joint.pitch_m_per_rad = pitch_m_per_rad_;
    state.memory[angle_] = joint.position;
    state.memory[rate_] = joint.velocity;
    state.memory[turns_] = joint.position / (2 * kPi);
    state.memory[travel_] = joint.position * pitch_m_per_rad_;
  }

 private:
  JointSwitch joint_;
  double pitch_m_per_rad_;
  std::size_t angle_;
  std::size_t rate_;
  std::size_t turns_;
  std::size_t travel_;
};

Expected<std::unique_ptr<Agent>> make_screw(const Build& build) {
  auto joint = JointSwitch::create(build, state::JointKind::hinge, "SingleAxisHingeJoint",
                                   {"frictionTorque", "viscous", "minAngle", "maxAngle"});
  if (!joint) return tl::unexpected(joint.error());
  return std::make_unique<Screw>(build, *joint);
}

constexpr state::ParameterType kScrewParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the hinge that is on, and a screw, while this agent is on",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "pitch",
     .unit = "m",
     .summary = "how far it goes along the axis in one turn; below 0: a left-handed thread",
     .required = true,
     .min = -10,
     .max = 10},
    {.name = "frictionTorque",
     .unit = "N m",
     .summary = "Coulomb friction of the real thread; felt times the world's effort_scale",
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
constexpr state::ValueType kScrewValues[] = {
    {"angle", "rad", "of body2 against body1; counts on over whole turns"},
    {"rate", "rad/s", "how fast it turns"},
    {"turns", "", "the angle in turns"},
    {"travel", "m", "how far it has gone along the axis"},
};

}  // namespace

const AgentKind& screw_kind() {
  static const AgentKind kKind{
      {"geometry.screw", "Ties two bodies by a screw thread while it is on", kScrewParameters, kScrewValues},
      make_screw};
  return kKind;
}

}  // namespace mechane::agents
