// What agents of joints share: a joint's switch, its friction, its drag, its stops. Outside this room, the scenario's
// compiler asks which joint an agent switches.
#pragma once

#include <string_view>

#include "server/agents/agent.hpp"

namespace mechane::agents {

/// Names of the parameters that a type reads its joint's feel from.
struct JointSwitchNames {
  std::string_view friction;
  std::string_view viscous;
  std::string_view least;
  std::string_view most;
};

/// A joint, its feel and its stops, as an agent writes them into the state in each tick.
class JointSwitch {
 public:
  /// Errors: the joint is not of that kind, one stop without the other, swapped stops, another agent that switches the same joint.
  [[nodiscard]] static Expected<JointSwitch> create(const Build& build, state::JointKind kind,
                                                    const JointSwitchNames& names);

  /// Switches the joint; returns it.
  state::JointState& apply(state::WorldState& state, bool enabled) const noexcept;

 private:
  JointId joint_;
  double friction_ = 0;
  double viscous_ = 0;
  bool limited_ = false;
  double min_ = 0;
  double max_ = 0;
};

/// The joint that an agent switches on and off; none for agents that do not.
[[nodiscard]] JointId switched_joint(const state::WorldDescription& description,
                                     const state::ComponentDescription& agent);

/// conflict: the parameters joint1 and joint2 name the same joint.
[[nodiscard]] Expected<void> check_two_joints(const Build& build);

}  // namespace mechane::agents
