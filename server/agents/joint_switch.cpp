#include "server/agents/joint_switch.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace mechane::agents {
namespace {

constexpr std::array<std::string_view, 4> kSwitches{"geometry.hinge", "geometry.slider", "geometry.ball",
                                                    "geometry.screw"};

}  // namespace

JointId switched_joint(const state::WorldDescription& description, const state::ComponentDescription& agent) {
  if (std::find(kSwitches.begin(), kSwitches.end(), agent.type) == kSwitches.end()) return {};
  const std::string* joint = agent.written_text("joint");
  return joint != nullptr ? description.find_joint(*joint) : JointId::none();
}

namespace {

/// conflict: another agent switches the same joint.
Expected<void> check_only_switch(const Build& build) {
  const JointId joint = build.parameters.joint("joint");
  for (const state::ComponentDescription& other : build.description.agents) {
    if (&other != &build.component && switched_joint(build.description, other) == joint)
      return fail(ErrorCode::conflict, "the agent '" + other.name + "' switches the same joint", build.place("joint"),
                  "keep one agent for each joint");
  }
  return {};
}

}  // namespace

Expected<void> check_two_joints(const Build& build) {
  if (build.parameters.joint("joint1") != build.parameters.joint("joint2")) return {};
  return fail(ErrorCode::conflict, "joint1 and joint2 are the same joint", build.place("joint2"), "name two joints");
}

Expected<JointSwitch> JointSwitch::create(const Build& build, state::JointKind kind, const JointSwitchNames& names) {
  const state::Parameters& p = build.parameters;
  const auto joint = build.joint("joint", kind);
  if (!joint) return tl::unexpected(joint.error());
  JointSwitch out;
  out.joint_ = *joint;
  if (auto only = check_only_switch(build); !only) return tl::unexpected(only.error());
  if (!names.friction.empty()) out.friction_ = p.number(names.friction) * build.description.effort_scale;
  if (!names.viscous.empty()) out.viscous_ = p.number(names.viscous) * build.description.effort_scale;
  if (names.least.empty()) return out;
  if (p.given(names.least) != p.given(names.most))
    return fail(ErrorCode::missing, fmt::format("only one of {} and {} is given", names.least, names.most),
                build.place(p.given(names.least) ? names.least : names.most),
                kind == state::JointKind::hinge ? "give both, or neither for a hinge that turns without end"
                                                : "give both, or neither");
  out.limited_ = p.given(names.least);
  out.min_ = p.number(names.least);
  out.max_ = p.number(names.most);
  if (out.limited_ && out.min_ > out.max_)
    return fail(ErrorCode::conflict, fmt::format("{} is above {}", names.least, names.most), build.place(names.least),
                "swap them");
  return out;
}

state::JointState& JointSwitch::apply(state::WorldState& state, bool enabled) const noexcept {
  state::JointState& joint = state[joint_];
  joint.enabled = enabled;
  joint.friction = friction_;
  joint.viscous = viscous_;
  if (limited_) {
    joint.min_position = min_;
    joint.max_position = max_;
  }
  return joint;
}

}  // namespace mechane::agents
