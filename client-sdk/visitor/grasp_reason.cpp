#include "client-sdk/visitor/grasp_reason.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "server/state/affordances.hpp"

namespace mechane::visitor {
namespace {

/// A flag of the body: as the step sets it, or else as the body has it, if no other step sets it. Empty: it depends on
/// the steps before.
std::optional<bool> flag_in(const state::WorldDescription& world, StepId step, BodyId body,
                            std::optional<bool> state::BodyOverride::*flag, bool otherwise) {
  bool set_elsewhere = false;
  for (std::size_t i = 0; i < world.steps.size(); ++i) {
    for (const state::BodyOverride& change : world.steps[i].bodies) {
      if (change.body != body || !(change.*flag)) continue;
      if (step == StepId(i)) return change.*flag;
      set_elsewhere = true;
    }
  }
  return set_elsewhere ? std::nullopt : std::optional(otherwise);
}

/// The agents by which hands can take the body.
std::vector<std::string> takers_of(const state::WorldDescription& world, BodyId body) {
  std::vector<std::string> names;
  for (const state::Affordance& affordance : state::affordances_of(world)) {
    if (affordance.kind == state::Affordance::Kind::taken && affordance.object == body)
      names.push_back(world.agents[affordance.agent.index()].name);
  }
  return names;
}

}  // namespace

std::string why_not_grasped(const FailedGrasp& grasp, const state::WorldDescription& world, StepId step,
                            std::span<const std::string> enabled_agents) {
  const state::BodyDescription& body = world.bodies[grasp.body.index()];
  const std::string in_step = step ? fmt::format("in step '{}'", world.steps[step.index()].name) : "now";
  if (body.fixed) return fmt::format("{} is fixed; let the visit grasp a body that can move", body.name);
  if (flag_in(world, step, grasp.body, &state::BodyOverride::graspable, body.graspable) == false)
    return fmt::format("{} is not graspable {}; set graspable to true in the body, or in the step's entry for it",
                       body.name, in_step);
  if (flag_in(world, step, grasp.body, &state::BodyOverride::movable, true) == false)
    return fmt::format("{} is not movable {}; set movable to true in the step's entry for the body", body.name,
                       in_step);
  const std::vector<std::string> takers = takers_of(world, grasp.body);
  if (takers.empty()) {
    return fmt::format("no agent lets hands take {}; add it to the bodies of a simulation.grasp", body.name);
  }
  const auto is_on = [&](const std::string& name) {
    return std::ranges::find(enabled_agents, name) != enabled_agents.end();
  };
  if (std::ranges::none_of(takers, is_on))
    return fmt::format("the agent '{}', which lets hands take {}, is disabled {}; enable it there", takers.front(),
                       body.name, in_step);
  if (!grasp.touched) {
    return fmt::format(
        "the hand felt nothing and came within {:.3f} m of the grip of {}; let the visit reach for a point on its "
        "surface",
        grasp.nearest_m, body.name);
  }
  return fmt::format(
      "the hand touched something, but did not get hold of {}: it may already be in its place, or the hand touched "
      "another "
      "body; let the visit release first, or reach from another side",
      body.name);
}

}  // namespace mechane::visitor
