// Warnings of surfaces that change nothing or that no hand feels, and of pulls that no hand feels or withstands.
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"
#include "server/state/surface_keys.hpp"

namespace mechane::scenario {
namespace {

using state::ComponentDescription;
using state::StepDescription;

void warn_of_agent(Compilation& c, const ComponentDescription& agent, std::string_view key, std::string what,
                   std::string remedy) {
  c.problems.warning(ErrorCode::conflict, state::parameter_place(agent, key).line, "agent " + agent.name,
                     std::move(what), std::move(remedy));
}

/// Whether an agent names another one in this parameter, by which it switches it.
bool is_named(const state::WorldDescription& world, const std::string& name, const std::string& parameter) {
  return std::ranges::any_of(world.agents, [&](const ComponentDescription& agent) {
    const auto* texts = agent.written<std::vector<std::string>>(parameter);
    return texts != nullptr && std::ranges::find(*texts, name) != texts->end();
  });
}

bool is_switched(const state::WorldDescription& world, AgentId agent) {
  const auto switches = [&](const StepDescription& step) {
    return names(step.enable, agent) || names(step.disable, agent);
  };
  return std::ranges::any_of(world.steps, switches) || is_named(world, world.agents[agent.index()].name, "releases");
}

void check_surface(Compilation& c, AgentId id) {
  const ComponentDescription& agent = c.world.agents[id.index()];
  const std::string& body = *agent.written_text("object");
  const auto is_written = [&](const state::ParameterType& key) {
    return agent.parameters.contains(std::string(key.name));
  };
  if (std::ranges::none_of(state::kSurfaceKeys, is_written)) {
    warn_of_agent(c, agent, "type", fmt::format("it changes nothing: '{}' feels as it does without it", body),
                  "write in what the body feels otherwise, like stiffness or viscosity, or remove the agent");
  } else if (!c.touchable[c.world.find_body(body).index()]) {
    warn_of_agent(c, agent, "object", fmt::format("it is never felt: no hand can touch '{}'", body),
                  "let hands touch the body by its mechane:body (model, touchable), or remove the agent");
  } else if (!is_switched(c.world, id)) {
    warn_of_agent(
        c, agent, "type", fmt::format("no step switches it, so '{}' always feels so", body),
        fmt::format("enable '{}' in a step, or write its keys into the mechane:haptic of '{}'", agent.name, body));
  }
}

/// What must come together so that a hand carries a body while its snap is on: one bit each.
constexpr unsigned kGraspable = 1, kMovable = 2, kGraspOn = 4, kSnapOn = 8, kCarried = 15;

/// Who could carry what, and to where.
struct Carriage {
  BodyId body;
  AgentId grasp;
  AgentId snap;
};

/// The bits after a step has begun.
unsigned after(const StepDescription& step, const Carriage& of, unsigned bits) {
  const auto set = [&](unsigned bit, bool on) { bits = on ? bits | bit : bits & ~bit; };
  if (const state::BodyOverride* change = override_of(step, of.body)) {
    set(kGraspable, change->graspable.value_or((bits & kGraspable) != 0));
    set(kMovable, change->movable.value_or((bits & kMovable) != 0));
  }
  set(kGraspOn, on_after(step, of.grasp, (bits & kGraspOn) != 0));
  set(kSnapOn, on_after(step, of.snap, (bits & kSnapOn) != 0));
  return bits;
}

/// Whether an activity, on some way through its steps, lets a hand carry the body while the snap is on.
bool is_carried(const state::WorldDescription& world, const state::ActivityDescription& activity, const Carriage& of) {
  const state::BodyDescription& body = world.bodies[of.body.index()];
  // simulation.assembled switches its parts' snaps.
  const unsigned always = is_named(world, world.agents[of.snap.index()].name, "parts") ? kSnapOn : 0;
  const unsigned begin = (body.graspable ? kGraspable : 0) | (body.fixed ? 0 : kMovable) |
                         (on_at_start(world, of.grasp) ? kGraspOn : 0) | (on_at_start(world, of.snap) ? kSnapOn : 0);
  std::vector<std::array<bool, kCarried + 1>> seen(world.steps.size());
  std::vector<std::pair<StepId, unsigned>> open{{activity.first, begin}};
  while (!open.empty()) {
    const auto [id, before] = open.back();
    open.pop_back();
    const unsigned bits = after(world.steps[id.index()], of, before) | always;
    if (bits == kCarried) return true;
    if (std::exchange(seen[id.index()][bits], true)) continue;
    for (const StepId next : next_steps(world.steps[id.index()]))
      open.emplace_back(next, bits);
  }
  return false;
}

bool may_take(const ComponentDescription& grasp, const std::string& body) {
  if (grasp.type != "simulation.grasp") return false;
  const auto* bodies = grasp.written<std::vector<std::string>>("bodies");
  return bodies == nullptr || std::ranges::find(*bodies, body) != bodies->end();
}

/// The grasps by which a hand can carry the body while the snap is on.
std::vector<AgentId> grasps_of(const Compilation& c, BodyId body, AgentId snap) {
  std::vector<AgentId> grasps;
  if (!c.touchable[body.index()]) return grasps;
  for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
    const auto carries = [&](const state::ActivityDescription& activity) {
      return activity.first && is_carried(c.world, activity, {body, AgentId(i), snap});
    };
    if (may_take(c.world.agents[i], c.world.bodies[body.index()].name) &&
        std::ranges::any_of(c.world.activities, carries))
      grasps.emplace_back(i);
  }
  return grasps;
}

void check_pull(Compilation& c, AgentId id) {
  const ComponentDescription& snap = c.world.agents[id.index()];
  const auto* pull = snap.written<std::vector<double>>("pull");
  if (pull == nullptr || pull->front() == 0) return;
  const std::string& body = *snap.written_text("object");
  const std::vector<AgentId> grasps = grasps_of(c, c.world.find_body(body), id);
  if (grasps.empty())
    return warn_of_agent(
        c, snap, "pull",
        fmt::format("the pull is never felt: in no step can a hand carry '{}' while '{}' is on", body, snap.name),
        fmt::format("let one step have '{}' touchable, graspable and movable, with '{}' and a "
                    "simulation.grasp of it on; or remove the pull",
                    body, snap.name));
  for (const AgentId grasp : grasps) {
    const ComponentDescription& hand = c.world.agents[grasp.index()];
    const double limit_n = parameter_of(hand, *find_agent_type(hand.type), "forceLimit");
    if (pull->front() < limit_n) continue;
    warn_of_agent(c, snap, "pull",
                  fmt::format("the pull of {:g} N tears '{}' out of the hand: the forceLimit of '{}' is {:g} N",
                              pull->front(), body, hand.name, limit_n),
                  fmt::format("write a pull well below {:g}, or a larger forceLimit", limit_n));
  }
}

}  // namespace

void lint_touch(Compilation& c) {
  for (std::size_t i = 0; i < c.world.agents.size(); ++i) {
    if (c.world.agents[i].type == "touch.surface") check_surface(c, AgentId(i));
    if (c.world.agents[i].type == "geometry.snap") check_pull(c, AgentId(i));
  }
}

}  // namespace mechane::scenario
