// geometry.hinge: a joint's switch, friction and limits. geometry.screw: a hinge that goes along its axis as it turns, by the pitch of its
// thread.
#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Hinge : public Agent {
 public:
  Hinge(const Build& build, const JointSwitch& joint)
      : joint_(joint), angle_(build.slot("angle")), rate_(build.slot("rate")), turns_(build.slot("turns")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override { turn(state, enabled); }

 protected:
  /// The tick; returns the joint.
  state::JointState& turn(state::WorldState& state, bool enabled) const noexcept {
    state::JointState& joint = joint_.apply(state, enabled);
    state.memory[angle_] = joint.position;
    state.memory[rate_] = joint.velocity;
    state.memory[turns_] = joint.position / (2 * kPi);
    return joint;
  }

 private:
  JointSwitch joint_;
  std::size_t angle_;
  std::size_t rate_;
  std::size_t turns_;
};

class Screw final : public Hinge {
 public:
  Screw(const Build& build, const JointSwitch& joint)
      : Hinge(build, joint),
        pitch_m_per_rad_(build.parameters.number("pitch") / (2 * kPi)),
        travel_(build.slot("travel")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    state::JointState& joint = turn(state, enabled);
    joint.pitch_m_per_rad = pitch_m_per_rad_;
    state.memory[travel_] = joint.position * pitch_m_per_rad_;
  }

 private:
  double pitch_m_per_rad_;
  std::size_t travel_;
};

template <class Turning>
Expected<std::unique_ptr<Agent>> make_turning(const Build& build) {
  auto joint =
      JointSwitch::create(build, state::JointKind::hinge, {"frictionTorque", "viscous", "minAngle", "maxAngle"});
  if (!joint) return tl::unexpected(joint.error());
  return std::make_unique<Turning>(build, *joint);
}

constexpr state::ParameterType kTurningDrag{
    .name = "viscous",
    .unit = "N m s/rad",
    .summary = "drag that grows with the rate; felt times the world's effort_scale",
    .min = 0,
    .max = 1e6};
constexpr state::ParameterType kMinAngle =
    state::joint_position("minAngle", "rad", "lower stop; with maxAngle. Neither: the joint's own");
constexpr state::ParameterType kMaxAngle = state::joint_position("maxAngle", "rad", "upper stop; with minAngle");
constexpr state::ValueType kAngle{"angle", "rad", "of body2 against body1; counts on over whole turns"};
constexpr state::ValueType kRate{"rate", "rad/s", "how fast it turns"};
constexpr state::ValueType kTurns{"turns", "", "the angle in turns"};

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
    kTurningDrag,
    kMinAngle,
    kMaxAngle,
};
constexpr state::ValueType kHingeValues[] = {kAngle, kRate, kTurns};

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
    kTurningDrag,
    kMinAngle,
    kMaxAngle,
};
constexpr state::ValueType kScrewValues[] = {
    kAngle,
    kRate,
    kTurns,
    {"travel", "m", "how far it has gone along the axis"},
};

}  // namespace

const AgentKind& hinge_kind() {
  static const AgentKind kKind{
      {"geometry.hinge", "Ties two bodies by a hinge while it is on", kHingeParameters, kHingeValues},
      make_turning<Hinge>};
  return kKind;
}

const AgentKind& screw_kind() {
  static const AgentKind kKind{
      {"geometry.screw", "Ties two bodies by a screw thread while it is on", kScrewParameters, kScrewValues},
      make_turning<Screw>};
  return kKind;
}

}  // namespace mechane::agents
