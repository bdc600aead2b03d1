#include "server/machines/machine.hpp"

#include "server/base/assert.hpp"

namespace mechane::machines {

Expected<void> Machine::link(const state::MemoryLayout& /*layout*/) {
  return {};
}

Expected<JointId> read_joint(const Build& build, const std::string& parameter, state::JointKind kind) {
  MECHANE_ASSERT(kind == state::JointKind::hinge || kind == state::JointKind::slider);
  const JointId joint = build.parameters.joint(parameter);
  if (build.description.joints[joint.index()].kind == kind) return joint;
  const bool turns = kind == state::JointKind::hinge;
  return fail("the " + parameter + " '" + build.parameters.text(parameter) + "' does not " + (turns ? "turn" : "slide"),
              state::component_place(build.component), turns ? "name a SingleAxisHingeJoint" : "name a SliderJoint");
}

}  // namespace mechane::machines
