// geometry.intermittent_gear: a drum with one tooth moves a wheel by one of its teeth a turn (Vitruvius X.9, the odometer).
#include <cmath>

#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class IntermittentGear final : public Agent {
 public:
  explicit IntermittentGear(const Build& build)
      : joint1_(build.parameters.joint("joint1")),
        joint2_(build.parameters.joint("joint2")),
        engaged_(build.slot("engaged")),
        steps_(build.slot("steps")),
        offset_(build.slot("own.offset")),
        started_(build.slot("own.started")) {
    const double step = 2 * kPi / build.parameters.number("teeth");
    gear_.kind = state::CouplingKind::intermittent;
    gear_.joint1 = joint1_;
    gear_.joint2 = joint2_;
    gear_.step = build.parameters.boolean("inside") ? step : -step;
    gear_.window = build.parameters.number("window");
    gear_.phase = build.parameters.number("phase");
    gear_.lock = build.parameters.boolean("lock");
    coupling_ = build.coupling(gear_);
  }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const bool meshes = enabled && state[joint1_].enabled && state[joint2_].enabled;
    const double position = state[joint2_].position;
    if (meshes && state.memory[engaged_] == 0) {
      state.memory[offset_] = state::intermittent_position(gear_, state[joint1_].position) - position;
      state.memory[started_] = position;
    }
    state.memory[engaged_] = meshes ? 1 : 0;
    state::Coupling& gear = state.couplings[coupling_];
    gear.enabled = meshes;
    gear.offset = state.memory[offset_];
    state.memory[steps_] = meshes ? std::round(std::abs((position - state.memory[started_]) / gear_.step)) : 0;
  }

 private:
  JointId joint1_;
  JointId joint2_;
  state::Coupling gear_;
  std::size_t coupling_ = 0;
  std::size_t engaged_;
  std::size_t steps_;
  std::size_t offset_;
  std::size_t started_;  // the wheel's position when the tooth was put in
};

Expected<std::unique_ptr<Agent>> make_intermittent_gear(const Build& build) {
  for (const char* name : {"joint1", "joint2"}) {
    if (auto joint = build.joint(name, state::JointKind::hinge); !joint) return tl::unexpected(joint.error());
  }
  if (auto good = check_two_joints(build); !good) return tl::unexpected(good.error());
  return std::make_unique<IntermittentGear>(build);
}

constexpr state::ParameterType kIntermittentGearParameters[] = {
    {.name = "joint1",
     .kind = ParameterKind::text,
     .summary = "the hinge whose one tooth drives",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "joint2",
     .kind = ParameterKind::text,
     .summary = "the hinge of the wheel that is moved",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "teeth",
     .summary = "of the wheel: it goes 1/teeth of a turn each time",
     .required = true,
     .min = 1,
     .max = 1e5},
    {.name = "window",
     .unit = "rad",
     .summary = "how far joint1 turns while its tooth drives",
     .default_value = 0.5,
     .min = 0.02,
     .max = 6},
    {.name = "phase",
     .unit = "rad",
     .summary = "where joint1 stands in the middle of that",
     .default_value = kPi,
     .min = -100,
     .max = 100},
    {.name = "inside", .kind = ParameterKind::boolean, .summary = "the wheel turns the same way as the tooth"},
    {.name = "lock",
     .kind = ParameterKind::boolean,
     .summary = "the wheel is held while the tooth is elsewhere; false: only its bearing's friction holds it",
     .default_value = 1},
};
constexpr state::ValueType kIntermittentGearValues[] = {
    state::yes_or_no("engaged", "1 while it is on, and both joints are"),
    state::amount("steps", "", "teeth that the wheel has gone since then"),
};

}  // namespace

const AgentKind& intermittent_gear_kind() {
  static const AgentKind kKind{{"geometry.intermittent_gear", "One tooth moves a wheel by one of its teeth a turn",
                                kIntermittentGearParameters, kIntermittentGearValues},
                               make_intermittent_gear};
  return kKind;
}

}  // namespace mechane::agents
