#include "server/state/world_state.hpp"

#include <algorithm>
#include <limits>

namespace mechane::state {

WorldState::WorldState(const WorldDescription& description)
    : bodies(description.bodies.size()),
      joints(description.joints.size()),
      quantities(description.quantities.size(), 0.0),
      agent_enabled(description.agents.size(), 0),
      click_steps(description.effects.size(), std::numeric_limits<double>::quiet_NaN()) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyDescription& from = description.bodies[i];
    bodies[i].X_WB = from.X_WB;
    bodies[i].V_WB = from.V_WB;
    bodies[i].movable = !from.fixed && !from.driven;
    bodies[i].visible = from.visible;
    bodies[i].graspable = from.graspable;
    bodies[i].use_gravity = from.use_gravity;
    bodies[i].haptic = from.haptic;
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointDescription& from = description.joints[i];
    joints[i].enabled = from.enabled_at_start;
    joints[i].min_position = from.min_position;
    joints[i].max_position = from.max_position;
  }
  for (const StepDescription& step : description.steps) {
    for (const BodyOverride& change : step.bodies)
      if (change.use_gravity && std::ranges::find(weighed, change.body) == weighed.end())
        weighed.push_back(change.body);
  }
}

void WorldState::emit(EventKind kind, std::uint32_t subject, std::uint32_t object, double value) noexcept {
  if (event_count == events.size()) {
    ++events_dropped;
    return;
  }
  events[event_count++] = {tick, kind, subject, object, value};
}

bool UserState::touches(BodyId body) const noexcept {
  const auto is_it = [body](const auto& touch) { return touch.body == body; };
  return std::ranges::any_of(contact_span(), is_it) || std::ranges::any_of(side_span(), is_it);
}

void add_force(BodyState& body, const Vec3& f_B_W, const Vec3& p_WQ) noexcept {
  body.load_W.f += f_B_W;
  body.load_W.t += (p_WQ - body.X_WB.p).cross(f_B_W);
}

std::size_t MemoryLayout::add(const std::string& component, const std::string& value, double initial) {
  const std::size_t index = slots_.size();
  slots_.push_back({component + "." + value, index});
  initial_.push_back(initial);
  return index;
}

namespace {

const MemorySlot* slot_of(const std::vector<MemorySlot>& slots, const std::string& name) {
  const auto it = std::find_if(slots.begin(), slots.end(), [&](const MemorySlot& slot) { return slot.name == name; });
  return it == slots.end() ? nullptr : &*it;
}

}  // namespace

const MemorySlot* MemoryLayout::find(const std::string& name) const {
  return slot_of(slots_, name);
}

std::size_t MemoryLayout::add_coupling(const std::string& component, const Coupling& coupling) {
  const std::size_t index = couplings_.size();
  coupling_slots_.push_back({component, index});
  couplings_.push_back(coupling);
  return index;
}

const MemorySlot* MemoryLayout::find_coupling(const std::string& component) const {
  return slot_of(coupling_slots_, component);
}

}  // namespace mechane::state
