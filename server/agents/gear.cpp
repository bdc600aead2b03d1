// geometry.gear and geometry.worm: two joints that go together by a ratio.
//
// A worm is a gear whose teeth rub so much that its wheel cannot drive it. The friction on the worm is 1/efficiency - 1 of the tooth
// force: with an efficiency below one half it is larger than the tooth force itself.
#include <cmath>

#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::JointKind;
using state::ParameterKind;

class Gear final : public Agent {
 public:
  Gear(const Build& build, double ratio)
      : joint1_(build.parameters.joint("joint1")),
        joint2_(build.parameters.joint("joint2")),
        ratio_(ratio),
        real_per_felt_(build.real_per_felt()),
        engaged_(build.slot("engaged")),
        offset_(build.slot("own.offset")),
        torque_(build.slot("torque")),
        force_(build.slot("force")) {
    state::Coupling gear;
    gear.kind = state::CouplingKind::gear;
    gear.joint1 = joint1_;
    gear.joint2 = joint2_;
    gear.ratio = ratio;
    gear.loss = 1 / build.parameters.number("efficiency") - 1;
    coupling_ = build.coupling(gear);
  }

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    const bool meshes = enabled && state[joint1_].enabled && state[joint2_].enabled;
    if (meshes && state.memory[engaged_] == 0)
      state.memory[offset_] = ratio_ * state[joint1_].position - state[joint2_].position;
    state.memory[engaged_] = meshes ? 1 : 0;
    state::Coupling& gear = state.couplings[coupling_];
    gear.enabled = meshes;
    gear.offset = state.memory[offset_];
    state.memory[torque_] = gear.torque_nm * real_per_felt_;
    state.memory[force_] = gear.force_n * real_per_felt_;
  }

 private:
  JointId joint1_;
  JointId joint2_;
  double ratio_;
  double real_per_felt_;
  std::size_t coupling_ = 0;
  std::size_t engaged_;
  std::size_t offset_;  // of the positions when the teeth met
  std::size_t torque_;
  std::size_t force_;
};

Expected<void> check_joints(const Build& build) {
  for (const char* name : {"joint1", "joint2"}) {
    if (auto joint = build.hinge_or_slider(name); !joint) return tl::unexpected(joint.error());
  }
  return check_two_joints(build);
}

/// From ratio, teeth or radius, of which exactly one is given.
Expected<double> read_ratio(const Build& build) {
  const state::Parameters& p = build.parameters;
  const int given = p.given("ratio") + p.given("teeth") + p.given("radius");
  if (given == 0)
    return fail(ErrorCode::missing, "none of ratio, teeth and radius is given", build.place(), "write one of them");
  if (given > 1)
    return fail(ErrorCode::conflict, "more than one of ratio, teeth and radius is given",
                build.place(p.given("radius") ? "radius" : "teeth"), "keep one of them");
  const auto hinge = [&](const char* joint) {
    return build.description.joints[p.joint(joint).index()].kind == JointKind::hinge;
  };
  if (p.given("ratio")) {
    if (p.number("ratio") == 0)
      return fail(ErrorCode::invalid_value, "the ratio is 0", build.place("ratio"),
                  "write how far joint2 goes for 1 of joint1");
    return p.number("ratio");
  }
  if (p.given("teeth")) {
    if (!hinge("joint1") || !hinge("joint2"))
      return fail(ErrorCode::conflict, "teeth are given, but one of the joints is not a hinge", build.place("teeth"),
                  "give ratio or radius for a slider");
    return (p.boolean("inside") ? 1 : -1) * p.numbers("teeth")[0] / p.numbers("teeth")[1];
  }
  if (!hinge("joint1") || hinge("joint2"))
    return fail(ErrorCode::conflict, "a radius is given, but the joints are not a hinge and a slider",
                build.place("radius"), "name a hinge in joint1 and a slider in joint2");
  return p.number("radius") * (p.boolean("reverse") ? -1 : 1);
}

Expected<std::unique_ptr<Agent>> make_gear(const Build& build) {
  if (auto good = check_joints(build); !good) return tl::unexpected(good.error());
  const auto ratio = read_ratio(build);
  if (!ratio) return tl::unexpected(ratio.error());
  return std::make_unique<Gear>(build, *ratio);
}

Expected<std::unique_ptr<Agent>> make_worm(const Build& build) {
  if (auto good = check_joints(build); !good) return tl::unexpected(good.error());
  const double ratio = build.parameters.number("starts") / build.parameters.number("teeth");
  return std::make_unique<Gear>(build, build.parameters.boolean("reverse") ? -ratio : ratio);
}

constexpr state::ParameterType kJoint1{.name = "joint1",
                                       .kind = ParameterKind::text,
                                       .summary = "a hinge or slider; the worm",
                                       .required = true,
                                       .reference = state::Reference::joint};
constexpr state::ParameterType kJoint2{.name = "joint2",
                                       .kind = ParameterKind::text,
                                       .summary = "the hinge or slider that it moves; the worm's wheel",
                                       .required = true,
                                       .reference = state::Reference::joint};
constexpr state::ParameterType kGearParameters[] = {
    kJoint1,
    kJoint2,
    {.name = "ratio",
     .summary = "how far joint2 goes for 1 of joint1, in rad or m; below 0: the other way",
     .default_value = state::kNoDefault,
     .min = -1e4,
     .max = 1e4},
    {.name = "teeth",
     .kind = ParameterKind::numbers,
     .summary = "of both wheels; they turn against each other",
     .min = 1,
     .max = 1e5,
     .count = 2},
    {.name = "inside",
     .kind = ParameterKind::boolean,
     .summary = "with teeth: one wheel's teeth are inside, or a peg wheel at right angles turns the same way"},
    {.name = "radius", .unit = "m", .summary = "of a pinion or a drum that moves a rack", .min = 1e-4, .max = 100},
    {.name = "reverse", .kind = ParameterKind::boolean, .summary = "with radius: the rack goes the other way"},
    {.name = "efficiency",
     .summary = "work out of the teeth over work into them, driven by joint1; below 0.5 joint2 cannot drive",
     .default_value = 1,
     .min = 0.01,
     .max = 1},
};
constexpr state::ParameterType kWormParameters[] = {
    kJoint1,
    kJoint2,
    {.name = "teeth", .summary = "of the wheel", .required = true, .min = 1, .max = 1e5},
    {.name = "starts", .summary = "threads of the worm", .default_value = 1, .min = 1, .max = 100},
    {.name = "reverse", .kind = ParameterKind::boolean, .summary = "the wheel turns the other way"},
    {.name = "efficiency",
     .summary = "work out of the wheel over work into the worm; below one half, so that the wheel cannot turn the worm",
     .default_value = 0.4,
     .min = 0.01,
     .max = 0.49},
};
constexpr state::ValueType kGearValues[] = {
    state::yes_or_no("engaged", "1 while the teeth mesh: it is on, and both joints are"),
    {"torque", "N m", "of the teeth on a joint2 that is a hinge: the real torque"},
    {"force", "N", "of the teeth on a joint2 that is a slider: the real force"},
};

}  // namespace

const AgentKind& gear_kind() {
  static const AgentKind kKind{{"geometry.gear", "Two joints go together by a ratio: wheels, rack and pinion, drum",
                                kGearParameters, kGearValues},
                               make_gear};
  return kKind;
}

const AgentKind& worm_kind() {
  static const AgentKind kKind{
      {"geometry.worm", "A worm turns a wheel, which cannot turn the worm", kWormParameters, kGearValues}, make_worm};
  return kKind;
}

}  // namespace mechane::agents
