// geometry.ball: a ball joint's switch, and the cone that it stays in.
#include <cmath>

#include "server/agents/joint_switch.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Ball final : public Agent {
 public:
  Ball(const Build& build, const JointSwitch& joint, const Vec3& axis_J)
      : joint_(joint),
        description_(build.description.joints[build.parameters.joint("joint").index()]),
        axis_J_(axis_J),
        cone_rad_(build.parameters.number("coneAngle")),
        limited_(build.parameters.given("coneAngle")),
        tilt_(build.slot("tilt")) {}

  void run(state::WorldState& state, bool enabled, double /*dt_s*/) const noexcept override {
    state::JointState& joint = joint_.apply(state, enabled);
    joint.cone_axis_J = limited_ ? axis_J_ : Vec3(Vec3::Zero());
    joint.cone_rad = cone_rad_;
    const Quat R_W1 = description_.body1 ? state[description_.body1].X_WB.R : Quat::Identity();
    const Vec3 at_W = R_W1 * (description_.X_B1J.R * axis_J_);
    const Vec3 is_W = state[description_.body2].X_WB.R * (description_.X_B2J.R * axis_J_);
    state.memory[tilt_] = std::atan2(at_W.cross(is_W).norm(), at_W.dot(is_W));
  }

 private:
  JointSwitch joint_;
  const state::JointDescription& description_;
  Vec3 axis_J_;
  double cone_rad_;
  bool limited_;
  std::size_t tilt_;
};

Expected<std::unique_ptr<Agent>> make_ball(const Build& build) {
  auto joint = JointSwitch::create(build, state::JointKind::ball, {});
  if (!joint) return tl::unexpected(joint.error());
  const auto axis_J = build.direction("axis", Vec3::UnitY());
  if (!axis_J) return tl::unexpected(axis_J.error());
  return std::make_unique<Ball>(build, *joint, *axis_J);
}

constexpr state::ParameterType kBallParameters[] = {
    {.name = "joint",
     .kind = ParameterKind::text,
     .summary = "the ball joint that is on while this agent is",
     .required = true,
     .reference = state::Reference::joint},
    {.name = "coneAngle",
     .unit = "rad",
     .summary = "how far the axis may tilt; none: any way",
     .min = 0.01,
     .max = 3.1},
    state::direction("axis", "the cone's axis as the bodies stand at the start; none: 0 1 0"),
};
constexpr state::ValueType kBallValues[] = {
    state::amount("tilt", "rad", "how far the axis is from where it was at the start")};

}  // namespace

const AgentKind& ball_kind() {
  static const AgentKind kKind{
      {"geometry.ball", "Ties two bodies at a point while it is on", kBallParameters, kBallValues}, make_ball};
  return kKind;
}

}  // namespace mechane::agents
