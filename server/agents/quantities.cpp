#include "server/agents/quantities.hpp"

#include <algorithm>

#include "server/state/component_type.hpp"

namespace mechane::agents {
namespace {

constexpr std::size_t kMostNames = 60;  // in an error's list

std::string known_sources(const state::WorldDescription& description, const state::MemoryLayout& layout) {
  std::vector<std::string> names;
  for (const auto& slot : layout.slots()) {
    // The names of slots that a component keeps to itself have a second dot: "GRASP.user0.open_s".
    if (std::count(slot.name.begin(), slot.name.end(), '.') == 1) names.push_back(slot.name);
  }
  for (const auto& joint : description.joints)
    names.push_back(joint.name + ".angle|rate|turns|position");
  for (const auto& body : description.bodies)
    names.push_back(body.name + ".position.x|y|z, .speed");
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i)
    list += (i == 0 ? "" : ", ") + names[i];
  return names.size() > kMostNames ? list + " ..." : list;
}

}  // namespace

Expected<Quantities::Source> Quantities::resolve(const state::WorldDescription& description,
                                                 const state::MemoryLayout& layout,
                                                 const state::QuantityDescription& quantity) {
  const std::size_t dot = quantity.source.find('.');
  const std::string name = quantity.source.substr(0, dot);
  const std::string value = dot == std::string::npos ? "" : quantity.source.substr(dot + 1);
  const double factor = state::unit_factor(value, quantity.unit);
  if (const state::MemorySlot* slot = layout.find(quantity.source)) return Source{From::memory, slot->index, 0, factor};
  if (const JointId joint = description.find_joint(name)) {
    if (value == "angle" || value == "position") return Source{From::joint_position, joint.index(), 0, factor};
    if (value == "turns") return Source{From::joint_position, joint.index(), 0, 1 / (2 * kPi)};
    if (value == "rate") return Source{From::joint_velocity, joint.index(), 0, factor};
  }
  if (const BodyId body = description.find_body(name)) {
    for (int axis = 0; axis < 3; ++axis) {
      if (value == std::string("position.") + "xyz"[axis]) return Source{From::body_position, body.index(), axis, 1};
    }
    if (value == "speed") return Source{From::body_speed, body.index(), 0, 1};
  }
  const std::string known = known_sources(description, layout);
  return fail(ErrorCode::unknown_name, "the source '" + quantity.source + "' does not exist",
              "quantity " + quantity.name,
              known.empty() ? "add an agent, a machine, a joint or a body first" : "use one of: " + known);
}

Expected<Quantities> Quantities::create(const state::WorldDescription& description, const state::MemoryLayout& layout) {
  Quantities out;
  for (const state::QuantityDescription& quantity : description.quantities) {
    auto source = resolve(description, layout, quantity);
    if (!source) return tl::unexpected(source.error());
    out.sources_.push_back(*source);
  }
  return out;
}

void Quantities::update(state::WorldState& state) const noexcept {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    double value = 0;
    switch (source.from) {
      case From::memory:
        value = state.memory[source.index];
        break;
      case From::joint_position:
        value = state.joints[source.index].position;
        break;
      case From::joint_velocity:
        value = state.joints[source.index].velocity;
        break;
      case From::body_position:
        value = state.bodies[source.index].X_WB.p[source.axis];
        break;
      case From::body_speed:
        value = state.bodies[source.index].V_WB.v.norm();
        break;
    }
    state.quantities[i] = source.factor * value;
  }
}

}  // namespace mechane::agents
