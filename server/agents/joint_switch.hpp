// What agents that switch a joint share: its friction, its drag, its stops. Inside this room only.
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
  /// `node` is what X3D calls the kind.
  [[nodiscard]] static Expected<JointSwitch> create(const Build& build, state::JointKind kind, std::string_view node,
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

}  // namespace mechane::agents
