// geometry.slider: a straight guide's switch, friction and stops.
#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Slider final : public Agent {
 public:
  Slider(const Build& build, const JointSwitch& joint)
      : joint_(joint), position_(build.slot("position")), speed_(build.slot("speed")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const state::JointState& joint = joint_.apply(state, enabled);
    state.memory[position_] = joint.position;
    state.memory[speed_] = joint.velocity;
  }

 private:
  JointSwitch joint_;
  std::size_t position_;
  std::size_t speed_;
};

Expected<std::unique_ptr<Agent>> make_slider(const Build& build) {
  auto joint =
      JointSwitch::create(build, state::JointKind::slider, {"friction", "viscous", "minPosition", "maxPosition"});
  if (!joint) return tl::unexpected(joint.error());
  return std::make_unique<Slider>(build, *joint);
}

constexpr state::ParameterType kSliderParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the slider that is on while this agent is",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "friction",
     .unit = "N",
     .summary = "Coulomb friction of the real guide; felt times the world's effort_scale",
     .min = 0,
     .max = 1e7},
    {.name = "viscous",
     .unit = "N s/m",
     .summary = "drag that grows with the speed; felt times the world's effort_scale",
     .min = 0,
     .max = 1e7},
    state::joint_position("minPosition", "m", "lower stop; with maxPosition. Neither: the joint's own"),
    state::joint_position("maxPosition", "m", "upper stop; with minPosition"),
};
constexpr state::ValueType kSliderValues[] = {
    {"position", "m", "of body2 against body1, along the axis; 0 at the start"},
    {"speed", "m/s", "how fast it slides"},
};

}  // namespace

const AgentKind& slider_kind() {
  static const AgentKind kKind{
      {"geometry.slider", "Ties two bodies by a straight guide while it is on", kSliderParameters, kSliderValues},
      make_slider};
  return kKind;
}

}  // namespace mechane::agents
