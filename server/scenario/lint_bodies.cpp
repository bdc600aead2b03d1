// Warnings of bodies that fall, or that nobody can move any more, because an agent is off.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "server/agents/joint_switch.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using state::StepDescription;

/// Whether one of a component's texts, or only that parameter's, names a body.
bool names_body(const state::ComponentDescription& component, const std::string& body,
                std::string_view parameter = {}) {
  return std::ranges::any_of(component.parameters, [&](const auto& item) {
    const auto* texts = std::get_if<std::vector<std::string>>(&item.second);
    return texts != nullptr && (parameter.empty() || item.first == parameter) &&
           std::find(texts->begin(), texts->end(), body) != texts->end();
  });
}

bool joins(const state::JointDescription& joint, BodyId body) {
  return joint.body1 == body || joint.body2 == body;
}

/// Whether an agent keeps a body from falling while it is on.
bool holds(const state::WorldDescription& world, const state::ComponentDescription& agent, BodyId body) {
  if (const JointId joint = agents::switched_joint(world, agent)) return joins(world.joints[joint.index()], body);
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> kHolders{
      {{"geometry.fixed", "body"}, {"geometry.fixed", "to"}, {"geometry.rope", "bodies"}, {"geometry.snap", "object"}}};
  return std::ranges::any_of(kHolders, [&](const auto& holder) {
    return agent.type == holder.first && names_body(agent, world.bodies[body.index()].name, holder.second);
  });
}

/// A joint that no agent switches is always on.
bool has_own_joint(const state::WorldDescription& world, BodyId body) {
  for (std::size_t i = 0; i < world.joints.size(); ++i) {
    const auto switches = [&](const state::ComponentDescription& agent) {
      return agents::switched_joint(world, agent) == JointId(i);
    };
    if (joins(world.joints[i], body) && std::ranges::none_of(world.agents, switches)) return true;
  }
  return false;
}

bool moved_by_machine(const state::WorldDescription& world, const std::string& body) {
  return std::ranges::any_of(world.machines, [&](const auto& machine) { return names_body(machine, body); });
}

const state::BodyOverride* override_of(const StepDescription& step, BodyId body) {
  const auto it = std::ranges::find(step.bodies, body, &state::BodyOverride::body);
  return it == step.bodies.end() ? nullptr : &*it;
}

bool says_movable(const StepDescription& step, BodyId body) {
  const state::BodyOverride* change = override_of(step, body);
  return change != nullptr && change->movable.has_value();
}

/// Agents are on at the start, but for those that some step enables.
bool on_at_start(const state::WorldDescription& world, AgentId agent) {
  return std::ranges::none_of(world.steps, [&](const StepDescription& step) { return names(step.enable, agent); });
}

bool on_after(const StepDescription& step, AgentId agent, bool before) {
  return (before || names(step.enable, agent)) && !names(step.disable, agent);
}

/// Whether gravity moves the body as this step begins an activity; what collides may lie on something.
bool is_free(const state::WorldDescription& world, const StepDescription& first, BodyId id) {
  const state::BodyDescription& body = world.bodies[id.index()];
  const state::BodyOverride* change = override_of(first, id);
  const bool movable = !body.fixed && (change == nullptr || change->movable.value_or(true));
  return movable && body.use_gravity && !world.gravity_W.isZero() && !body.collides &&
         !moved_by_machine(world, body.name);
}

/// "until step 'turn' enables it"
std::string until_when(const state::WorldDescription& world, ActivityId activity, AgentId agent) {
  for (const StepDescription& step : world.steps) {
    if (step.activity == activity && names(step.enable, agent))
      return fmt::format("until step '{}' enables it", step.name);
  }
  return "in this activity: only another one enables it";
}

void check_fall(Compilation& c, ActivityId activity, StepId first, BodyId body) {
  const StepDescription& step = c.world.steps[first.index()];
  if (!is_free(c.world, step, body) || has_own_joint(c.world, body)) return;
  AgentId missing;
  for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
    const AgentId agent(i);
    if (!holds(c.world, c.world.agents[i], body)) continue;
    if (on_after(step, agent, on_at_start(c.world, agent))) return;
    if (!missing) missing = agent;
  }
  if (!missing) return;
  const std::string& name = c.world.bodies[body.index()].name;
  c.problems.warning(c.step_lines[first.index()], "step " + step.name,
                     fmt::format("the body '{}' falls as this step begins: the agent '{}', which holds it, is off {}",
                                 name, c.world.agents[missing.index()].name, until_when(c.world, activity, missing)),
                     fmt::format("enable '{}' in this step, or hold the body still: movable false in object:{}",
                                 c.world.agents[missing.index()].name, name));
}

void check_falls(Compilation& c) {
  for (std::size_t a = 0; a < c.world.activities.size(); ++a) {
    const StepId first = c.world.activities[a].first;
    for (std::size_t b = 0; first && b < c.world.bodies.size(); ++b)
      check_fall(c, ActivityId(a), first, BodyId(b));
  }
}

/// Whether an agent may be on when the step begins, before the step switches it.
bool may_be_on(const state::WorldDescription& world, StepId step, AgentId agent) {
  const StepId first = world.activities[world.steps[step.index()].activity.index()].first;
  std::vector<StepId> on;
  // Steps in which it is on, from wherever it is switched on.
  for (std::size_t i = 0; i < world.steps.size(); ++i) {
    const bool begins = StepId(i) == first && on_at_start(world, agent);
    if (world.steps[i].activity == world.steps[step.index()].activity && on_after(world.steps[i], agent, begins))
      on.push_back(StepId(i));
  }
  const auto stays_on = [&](StepId id) { return on_after(world.steps[id.index()], agent, true); };
  return std::ranges::any_of(steps_from(world, std::move(on), stays_on), [&](StepId id) {
    const std::vector<StepId> next = next_steps(world.steps[id.index()]);
    return std::find(next.begin(), next.end(), step) != next.end();
  });
}

/// A snap that is switched off lets go of nothing: what it has placed stands still for good.
void check_stuck(Compilation& c, StepId id, AgentId snap) {
  const state::ComponentDescription& agent = c.world.agents[snap.index()];
  const std::string* object = agent.written_text("object");
  const bool* tied = agent.written<bool>("tied");
  if (agent.type != "geometry.snap" || (tied != nullptr && *tied) || object == nullptr) return;
  const BodyId body = c.world.find_body(*object);
  if (!body || moved_by_machine(c.world, *object) || !may_be_on(c.world, id, snap)) return;
  const StepDescription& step = c.world.steps[id.index()];
  const auto settles = [&](StepId later) {
    const StepDescription& s = c.world.steps[later.index()];
    return says_movable(s, body) || names(s.enable, snap);
  };
  if (says_movable(step, body) || std::ranges::any_of(steps_from(c.world, next_steps(step)), settles)) return;
  c.problems.warning(
      c.step_lines[id.index()], "step " + step.name,
      fmt::format("'{}' is switched off, but a body that it has placed stays immovable: '{}' cannot be taken or fall",
                  agent.name, *object),
      fmt::format("write movable into object:{} of this step: true frees it, false keeps it there", *object));
}

void check_snaps(Compilation& c) {
  for (std::size_t i = 0; i < c.world.steps.size(); ++i) {
    for (const AgentId agent : c.world.steps[i].disable)
      check_stuck(c, StepId(i), agent);
  }
}

}  // namespace

void lint_bodies(Compilation& c) {
  check_falls(c);
  check_snaps(c);
}

}  // namespace mechane::scenario
