// What compiles, but likely is not meant.
#include <algorithm>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using state::StepDescription;

bool names(const std::vector<AgentId>& list, AgentId agent) {
  return std::find(list.begin(), list.end(), agent) != list.end();
}

void check_texts(Compilation& c, const state::Texts& texts, int line, const std::string& where, std::string_view what) {
  std::vector<std::string> missing;
  for (const std::string& language : c.world.languages) {
    const auto it = texts.find(language);
    if (it == texts.end() || it->second.empty()) missing.push_back(language);
  }
  if (missing.empty()) return;
  c.problems.warning(line, where, fmt::format("the {} is missing in: {}", what, fmt::join(missing, ", ")),
                     fmt::format("add {}.{}", what, missing.front()));
}

void check_all_texts(Compilation& c) {
  check_texts(c, c.world.title, c.scenario->line, "mechane:scenario", "title");
  for (std::size_t i = 0; i < c.world.activities.size(); ++i) {
    check_texts(c, c.world.activities[i].title, c.activity_lines[i], "activity " + c.world.activities[i].name, "title");
  }
  for (std::size_t i = 0; i < c.world.steps.size(); ++i) {
    const StepDescription& step = c.world.steps[i];
    // A step must say what to do; narration and hint may be absent, but not in one language only.
    check_texts(c, step.texts.contains("caption") ? step.texts.at("caption") : state::Texts{}, c.step_lines[i],
                "step " + step.name, "caption");
    for (const auto& [what, texts] : step.texts) {
      if (what != "caption") check_texts(c, texts, c.step_lines[i], "step " + step.name, what);
    }
  }
}

void check_reach(Compilation& c) {
  std::vector<bool> reached(c.world.steps.size(), false);
  std::vector<StepId> open;
  for (const state::ActivityDescription& activity : c.world.activities) {
    if (activity.first) open.push_back(activity.first);
  }
  while (!open.empty()) {
    const StepId id = open.back();
    open.pop_back();
    if (reached[id.index()]) continue;
    reached[id.index()] = true;
    for (const state::TriggerDescription& trigger : c.world.steps[id.index()].triggers) {
      if (trigger.next) open.push_back(trigger.next);
    }
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const StepDescription& step = c.world.steps[i];
    if (!reached[i]) {
      c.problems.warning(c.step_lines[i], "step " + step.name, "no trigger leads to this step",
                         "name it as the next of a trigger, or remove it");
    }
    if (step.triggers.empty()) {
      c.problems.warning(c.step_lines[i], "step " + step.name, "the step has no trigger: a visitor cannot leave it",
                         "add trigger:1");
    }
  }
}

/// The agent that a quantity reads; none where it reads something else.
AgentId agent_behind(const state::WorldDescription& world, QuantityId quantity) {
  const std::string& source = world.quantities[quantity.index()].source;
  const std::string name = source.substr(0, source.find('.'));
  return world.find_joint(name) ? AgentId::none() : world.find_agent(name);
}

/// A trigger that waits for an agent which the same step has switched off, or which no step of the activity has on.
void check_triggers(Compilation& c) {
  for (std::size_t i = 0; i < c.world.steps.size(); ++i) {
    const StepDescription& step = c.world.steps[i];
    for (const state::TriggerDescription& trigger : step.triggers) {
      const AgentId agent = agent_behind(c.world, trigger.quantity);
      if (!agent) continue;
      const auto enables = [&](const StepDescription& s) { return names(s.enable, agent); };
      const auto enables_here = [&](const StepDescription& s) { return s.activity == step.activity && enables(s); };
      const bool switched = std::any_of(c.world.steps.begin(), c.world.steps.end(), enables);
      const bool here = std::any_of(c.world.steps.begin(), c.world.steps.end(), enables_here);
      if (!names(step.disable, agent) && (!switched || here)) continue;
      c.problems.warning(
          c.step_lines[i], "step " + step.name,
          fmt::format("the trigger on '{}' can never fire: the agent '{}' is off in this step",
                      c.world.quantities[trigger.quantity.index()].name, c.world.agents[agent.index()].name),
          "enable the agent in this step");
    }
  }
}

void check_visits(Compilation& c) {
  for (std::size_t i = 0; i < c.world.activities.size(); ++i) {
    const auto plays = [&](const state::VisitDescription& visit) {
      return visit.activity == ActivityId(i) && !visit.moves.empty();
    };
    if (std::any_of(c.world.visits.begin(), c.world.visits.end(), plays)) continue;
    c.problems.warning(c.activity_lines[i], "activity " + c.world.activities[i].name,
                       "no visit plays it: neither tests nor the attract mode can", "add a set to 'visits'");
  }
}

void check_world(Compilation& c) {
  const int line = c.document[c.document.scene()].line;
  if (c.world.bodies.empty())
    c.problems.warning(line, "Scene", "there is no RigidBody: nothing can be touched", "add a RigidBodyCollection");
  if (c.world.viewpoints.empty())
    c.problems.warning(line, "Scene", "there is no Viewpoint", "add one that shows the whole machine");
  const auto graspable = [](const state::BodyDescription& body) { return body.graspable; };
  if (!c.world.bodies.empty() && std::none_of(c.world.bodies.begin(), c.world.bodies.end(), graspable)) {
    c.problems.warning(line, "Scene", "no body is graspable",
                       "add graspable true to the mechane:haptic of what is to be held");
  }
}

}  // namespace

void lint(Compilation& c) {
  check_all_texts(c);
  check_reach(c);
  check_triggers(c);
  check_visits(c);
  check_world(c);
}

}  // namespace mechane::scenario
