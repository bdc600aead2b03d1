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

/// Error: another agent switches the joint of this one.
Expected<void> check_only_switch(const Build& build) {
  const JointId joint = build.parameters.joint("joint");
  for (const state::ComponentDescription& other : build.description.agents) {
    if (&other != &build.component && switched_joint(build.description, other) == joint)
      return fail("the agent " + other.name + " switches the same joint", state::component_place(build.component),
                  "keep one agent for each joint");
  }
  return {};
}

}  // namespace

Expected<JointSwitch> JointSwitch::create(const Build& build, state::JointKind kind, std::string_view node,
                                          const JointSwitchNames& names) {
  const std::string where = state::component_place(build.component);
  const state::Parameters& p = build.parameters;
  JointSwitch out;
  out.joint_ = p.joint("joint");
  if (build.description.joints[out.joint_.index()].kind != kind)
    return fail(fmt::format("the joint '{}' is not of the kind that this agent needs", p.text("joint")), where,
                fmt::format("name a {}", node));
  if (auto only = check_only_switch(build); !only) return tl::unexpected(only.error());
  if (!names.friction.empty()) out.friction_ = p.number(names.friction) * build.description.effort_scale;
  if (!names.viscous.empty()) out.viscous_ = p.number(names.viscous) * build.description.effort_scale;
  if (names.least.empty()) return out;
  if (p.given(names.least) != p.given(names.most))
    return fail(
        fmt::format("only one of {} and {} is given", names.least, names.most), where,
        kind == state::JointKind::hinge ? "give both, or none for a hinge that turns on and on" : "give both, or none");
  out.limited_ = p.given(names.least);
  out.min_ = p.number(names.least);
  out.max_ = p.number(names.most);
  if (out.limited_ && out.min_ > out.max_)
    return fail(fmt::format("{} is above {}", names.least, names.most), where, "swap them");
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
