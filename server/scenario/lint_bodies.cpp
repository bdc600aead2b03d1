// Warnings of bodies that fall or drift away because nothing holds them, and of bodies that stay immovable or tied.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "server/agents/joint_switch.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using state::StepDescription;

/// Whether a component names a body, in that parameter or, without one, in any.
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

bool says_movable(const StepDescription& step, BodyId body) {
  const state::BodyOverride* change = override_of(step, body);
  return change != nullptr && change->movable.has_value();
}

/// As this step begins an activity.
bool has_weight(const state::WorldDescription& world, const StepDescription& first, BodyId id) {
  const state::BodyOverride* change = override_of(first, id);
  const bool falls = world.bodies[id.index()].use_gravity;
  return (change == nullptr ? falls : change->use_gravity.value_or(falls)) && !world.gravity_W.isZero();
}

/// Whether only an agent could hold the body as this step begins an activity. A body that collides may lie on something.
bool is_loose(const state::WorldDescription& world, const StepDescription& first, BodyId id) {
  const state::BodyDescription& body = world.bodies[id.index()];
  const state::BodyOverride* change = override_of(first, id);
  const bool movable = !body.fixed && (change == nullptr ? !body.driven : change->movable.value_or(!body.driven));
  return movable && !body.collides && !moved_by_machine(world, body.name) && !has_own_joint(world, id);
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
  if (!has_weight(c.world, step, body) || !is_loose(c.world, step, body)) return;
  AgentId missing;
  for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
    const AgentId agent(i);
    if (!holds(c.world, c.world.agents[i], body)) continue;
    if (on_after(step, agent, on_at_start(c.world, agent))) return;
    if (!missing) missing = agent;
  }
  if (!missing) return;
  const std::string& name = c.world.bodies[body.index()].name;
  c.problems.warning(ErrorCode::conflict, c.step_lines[first.index()], "step " + step.name,
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

/// Whether a push sends a body out of the exhibit: it has no weight, and its damping stops it too late.
bool glides_away(const state::WorldDescription& world, const StepDescription& first, BodyId id) {
  constexpr double kPush_m_per_s = 0.5, kRoom_m = 5;
  if (has_weight(world, first, id)) return false;
  // Damping leaves v (1 - damping)^t, so the way to rest is v / -ln(1 - damping).
  const double slowing_per_s = -std::log1p(-world.bodies[id.index()].linear_damping);
  return kPush_m_per_s > kRoom_m * slowing_per_s;
}

/// Whether a body begins the step within reach of its snap, which then takes it at once.
bool begins_in_place(const state::WorldDescription& world, const StepDescription& step,
                     const state::ComponentDescription& snap, BodyId id) {
  const auto pose_of = [&](BodyId body) {
    const state::BodyOverride* change = body ? override_of(step, body) : nullptr;
    if (change != nullptr && change->X_WB) return *change->X_WB;
    return body ? world.bodies[body.index()].X_WB : Pose{};
  };
  const std::string* into = snap.written_text("into");
  const auto* at = snap.written<std::vector<double>>("position");
  const Vec3 p_IT = at != nullptr ? Vec3(Eigen::Map<const Vec3>(at->data())) : Vec3::Zero();
  const Vec3 p_WT = pose_of(into != nullptr ? world.find_body(*into) : BodyId::none()) * p_IT;
  return (p_WT - pose_of(id).p).norm() <= snap.written<std::vector<double>>("tolerance")->front();
}

/// A body that hands can push away for good, at its own line: the remedy is there.
void check_drift(Compilation& c, BodyId id) {
  const state::BodyDescription& body = c.world.bodies[id.index()];
  if (!c.touchable[id.index()]) return;
  const auto is_held = [&](const StepDescription& first) {
    for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
      const state::ComponentDescription& agent = c.world.agents[i];
      const bool on = on_after(first, AgentId(i), on_at_start(c.world, AgentId(i)));
      if (!on || !holds(c.world, agent, id)) continue;
      if (agent.type != "geometry.snap" || begins_in_place(c.world, first, agent, id)) return true;
    }
    return false;
  };
  for (const state::ActivityDescription& activity : c.world.activities) {
    if (!activity.first) continue;
    const StepDescription& first = c.world.steps[activity.first.index()];
    if (!glides_away(c.world, first, id) || !is_loose(c.world, first, id) || is_held(first)) continue;
    return c.problems.warning(
        ErrorCode::conflict, c.body_lines[id.index()], "RigidBody " + body.name,
        fmt::format("the body '{}' drifts away once a hand pushes it: it has no weight and next to no damping, and "
                    "nothing holds it in step '{}'",
                    body.name, first.name),
        fmt::format("write autoDamp='true' linearDampingFactor='0.9' angularDampingFactor='0.9', or hold the body "
                    "still: movable false in object:{}",
                    body.name));
  }
}

/// Whether an agent may be on when the step begins, before the step switches it.
bool may_be_on(const state::WorldDescription& world, StepId step, AgentId agent) {
  const StepId first = world.activities[world.steps[step.index()].activity.index()].first;
  std::vector<StepId> on;
  // First the steps that switch it on, or begin with it on; then all during which it stays on.
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

/// Whether this step, or any that can follow it, does something.
bool here_or_later(const state::WorldDescription& world, StepId id,
                   const std::function<bool(const StepDescription&)>& does) {
  const StepDescription& step = world.steps[id.index()];
  return does(step) || std::ranges::any_of(steps_from(world, next_steps(step)),
                                           [&](StepId later) { return does(world.steps[later.index()]); });
}

/// A tied snap that is switched off unties nothing. Moving the body to another place parts it, and so does a breakable.
void check_tied(Compilation& c, StepId id, AgentId snap, BodyId body) {
  const state::ComponentDescription& agent = c.world.agents[snap.index()];
  const auto breaks = [&](const state::ComponentDescription& other) {
    const std::string* target = other.type == "geometry.breakable" ? other.written_text("agent") : nullptr;
    return target != nullptr && *target == agent.name;
  };
  const auto settles = [&](const StepDescription& s) {
    const state::BodyOverride* change = override_of(s, body);
    return names(s.enable, snap) || (change != nullptr && (change->X_WB || !change->movable.value_or(true)));
  };
  if (std::ranges::any_of(c.world.agents, breaks) || here_or_later(c.world, id, settles)) return;
  const std::string* into = agent.written_text("into");
  const std::string& object = c.world.bodies[body.index()].name;
  c.problems.warning(
      ErrorCode::conflict, c.step_lines[id.index()], "step " + c.world.steps[id.index()].name,
      fmt::format("'{}' is switched off, but a body that it has placed stays tied: '{}' cannot be taken from {}",
                  agent.name, object, into != nullptr ? "'" + *into + "'" : "its place"),
      fmt::format("leave '{}' on, or part the two: by a geometry.breakable on it, or by a position in object:{}",
                  agent.name, object));
}

/// A snap that is switched off does not release the body that it has placed.
void check_stuck(Compilation& c, StepId id, AgentId snap) {
  const state::ComponentDescription& agent = c.world.agents[snap.index()];
  const std::string* object = agent.written_text("object");
  if (agent.type != "geometry.snap" || object == nullptr) return;
  const BodyId body = c.world.find_body(*object);
  if (!body || moved_by_machine(c.world, *object) || !may_be_on(c.world, id, snap)) return;
  if (const bool* tied = agent.written<bool>("tied"); tied != nullptr && *tied) return check_tied(c, id, snap, body);
  const auto settles = [&](const StepDescription& s) { return says_movable(s, body) || names(s.enable, snap); };
  if (here_or_later(c.world, id, settles)) return;
  c.problems.warning(
      ErrorCode::conflict, c.step_lines[id.index()], "step " + c.world.steps[id.index()].name,
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
  for (std::size_t b = 0; b < c.world.bodies.size(); ++b)
    check_drift(c, BodyId(b));
  check_snaps(c);
}

}  // namespace mechane::scenario
