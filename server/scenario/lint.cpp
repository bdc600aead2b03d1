// Warnings of what compiles, but is likely not meant.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

using state::StepDescription;

void check_texts(Compilation& c, const state::Texts& texts, int line, const std::string& where, std::string_view what) {
  std::vector<std::string> missing;
  for (const std::string& language : c.world.languages) {
    const auto it = texts.find(language);
    if (it == texts.end() || it->second.empty()) missing.push_back(language);
  }
  if (missing.empty()) return;
  c.problems.warning(ErrorCode::missing, line, where,
                     fmt::format("the {} is missing in: {}", what, fmt::join(missing, ", ")),
                     fmt::format("add {}.{}", what, missing.front()));
}

void check_question(Compilation& c, const state::QuestionDescription& question, int line, const std::string& where) {
  check_texts(c, question.question, line, where, "question");
  for (const auto& answer : question.answers)
    check_texts(c, answer.text, line, where, "answer:" + answer.name);
  if (question.kind != state::QuestionDescription::Kind::scale) return;
  check_texts(c, question.low, line, where, "low");
  check_texts(c, question.high, line, where, "high");
}

/// A sound file that does not exist is a warning only: it may be recorded later, and its step is silent until then.
void check_sounds(Compilation& c) {
  for (std::size_t i = 0; i < c.world.steps.size(); ++i) {
    const auto audio = c.world.steps[i].texts.find("audio");
    if (audio == c.world.steps[i].texts.end()) continue;
    for (const auto& [language, url] : audio->second) {
      if (c.loader.content_hash(c.document.path().parent_path() / url)) continue;
      c.problems.warning(ErrorCode::not_found, c.step_lines[i], "step " + c.world.steps[i].name,
                         fmt::format("the sound file '{}' does not exist", url),
                         "record it, or correct audio." + language);
    }
  }
}

void check_all_texts(Compilation& c) {
  check_texts(c, c.world.title, c.scenario->line, "mechane:scenario", "title");
  for (std::size_t i = 0; i < c.world.bodies.size(); ++i) {
    const state::BodyDescription& body = c.world.bodies[i];
    if (!body.title.empty()) check_texts(c, body.title, c.body_lines[i], "mechane:body of " + body.name, "title");
  }
  for (const state::QuantityDescription& quantity : c.world.quantities) {
    if (quantity.label.empty()) continue;
    check_texts(c, quantity.label, c.quantity_lines[quantity.name], "quantity " + quantity.name, "label");
  }
  for (std::size_t i = 0; i < c.world.activities.size(); ++i) {
    const state::ActivityDescription& activity = c.world.activities[i];
    const std::string where = "activity " + activity.name;
    check_texts(c, activity.title, c.activity_lines[i], where, "title");
    if (!activity.goal.empty()) check_texts(c, activity.goal, c.activity_lines[i], where, "goal");
    for (std::size_t q = 0; q < activity.questionnaire.size(); ++q) {
      const state::QuestionDescription& question = activity.questionnaire[q];
      check_question(c, question, c.question_lines[i][q], where + ", question " + question.name);
    }
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
  std::vector<StepId> first;
  for (const state::ActivityDescription& activity : c.world.activities) {
    if (activity.first) first.push_back(activity.first);
  }
  std::vector<bool> reached(c.world.steps.size(), false);
  for (const StepId id : steps_from(c.world, std::move(first)))
    reached[id.index()] = true;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const StepDescription& step = c.world.steps[i];
    if (!reached[i]) {
      c.problems.warning(ErrorCode::missing, c.step_lines[i], "step " + step.name, "no trigger leads to this step",
                         "name it as the next of a trigger, or remove it");
    }
    if (step.triggers.empty() && step.timeout_s == 0) {
      c.problems.warning(ErrorCode::missing, c.step_lines[i], "step " + step.name,
                         "the step has no trigger: a visitor cannot leave it", "add trigger:1, or timeoutSeconds");
    }
  }
}

/// The agent that a quantity reads; none where it reads something else.
AgentId agent_behind(const state::WorldDescription& world, QuantityId quantity) {
  const std::string& source = world.quantities[quantity.index()].source;
  const std::string name = source.substr(0, source.find('.'));
  return world.find_joint(name) ? AgentId::none() : world.find_agent(name);
}

/// The agent that a rule waits for although it is off: the same step switches it off, or only steps of other activities switch it on.
AgentId agent_off(const Compilation& c, const StepDescription& step, QuantityId quantity) {
  const AgentId agent = agent_behind(c.world, quantity);
  if (!agent) return agent;
  const auto enables = [&](const StepDescription& s) { return names(s.enable, agent); };
  const auto enables_here = [&](const StepDescription& s) { return s.activity == step.activity && enables(s); };
  const bool switched = std::any_of(c.world.steps.begin(), c.world.steps.end(), enables);
  const bool here = std::any_of(c.world.steps.begin(), c.world.steps.end(), enables_here);
  return names(step.disable, agent) || (switched && !here) ? agent : AgentId::none();
}

void check_triggers(Compilation& c) {
  for (std::size_t i = 0; i < c.world.steps.size(); ++i) {
    const StepDescription& step = c.world.steps[i];
    for (const state::TriggerDescription& trigger : step.triggers) {
      std::vector<QuantityId> quantities{trigger.quantity};
      for (const state::RuleDescription& rule : trigger.more)
        quantities.push_back(rule.quantity);
      const auto off = [&](QuantityId quantity) { return static_cast<bool>(agent_off(c, step, quantity)); };
      const bool dead = trigger.any ? std::all_of(quantities.begin(), quantities.end(), off)
                                    : std::any_of(quantities.begin(), quantities.end(), off);
      if (!dead) continue;
      const QuantityId quantity = *std::find_if(quantities.begin(), quantities.end(), off);
      c.problems.warning(ErrorCode::conflict, c.step_lines[i], "step " + step.name,
                         fmt::format("the trigger on '{}' can never fire: the agent '{}' is off in this step",
                                     c.world.quantities[quantity.index()].name,
                                     c.world.agents[agent_off(c, step, quantity).index()].name),
                         "enable the agent in this step");
    }
  }
}

/// Goals that displays would mark on a gauge, and that are not on it.
void check_gauges(Compilation& c) {
  for (const WrittenRule& written : c.rules) {
    const state::QuantityDescription& quantity = c.world.quantities[written.rule.quantity.index()];
    if (!written.marked || !quantity.range || written.rule.comparison == state::Comparison::equal) continue;
    const state::GaugeRange range = *quantity.range;
    // Gauges of a speed that begin at 0 or above show it without its sign.
    const double goal = quantity.unit == "rpm" && range.least >= 0 ? std::abs(written.rule.value) : written.rule.value;
    if (goal >= range.least && goal <= range.greatest) continue;
    c.problems.warning(ErrorCode::conflict, written.line, written.where,
                       fmt::format("the goal {} is outside the gauge of '{}', which goes from {} to {}",
                                   written.rule.value, quantity.name, range.least, range.greatest),
                       fmt::format("let the gauge's {} be {}", goal < range.least ? "least" : "greatest", goal));
  }
}

void check_visits(Compilation& c) {
  for (std::size_t i = 0; i < c.world.activities.size(); ++i) {
    const auto plays = [&](const state::VisitDescription& visit) {
      return visit.activity == ActivityId(i) && !visit.moves.empty();
    };
    if (std::any_of(c.world.visits.begin(), c.world.visits.end(), plays)) continue;
    c.problems.warning(ErrorCode::missing, c.activity_lines[i], "activity " + c.world.activities[i].name,
                       "no visit plays this activity, so neither tests nor the attract mode can play it",
                       "add a set to 'visits'");
  }
}

void check_world(Compilation& c) {
  const int line = c.document[c.document.scene()].line;
  if (c.world.bodies.empty())
    c.problems.warning(ErrorCode::missing, line, "Scene", "there is no RigidBody: nothing can be touched",
                       "add a RigidBodyCollection");
  if (c.document.elements("Viewpoint").empty())
    c.problems.warning(ErrorCode::missing, line, "Scene",
                       "there is no Viewpoint: the picture shows what can move, from before and above",
                       "add one that shows the whole machine");
  const auto graspable = [](const state::BodyDescription& body) { return body.graspable; };
  // A sign to another exhibit is pointed at, not held.
  const auto points = [](const state::ComponentDescription& agent) { return agent.type == "simulation.point"; };
  if (!c.world.bodies.empty() && std::none_of(c.world.bodies.begin(), c.world.bodies.end(), graspable) &&
      std::none_of(c.world.agents.begin(), c.world.agents.end(), points)) {
    c.problems.warning(ErrorCode::missing, line, "Scene", "no body is graspable",
                       "add graspable true to the mechane:haptic of a body that hands can take");
  }
}

}  // namespace

bool names(const std::vector<AgentId>& list, AgentId agent) {
  return std::find(list.begin(), list.end(), agent) != list.end();
}

const state::BodyOverride* override_of(const StepDescription& step, BodyId body) {
  const auto it = std::ranges::find(step.bodies, body, &state::BodyOverride::body);
  return it == step.bodies.end() ? nullptr : &*it;
}

bool on_at_start(const state::WorldDescription& world, AgentId agent) {
  return std::ranges::none_of(world.steps, [&](const StepDescription& step) { return names(step.enable, agent); });
}

bool on_after(const StepDescription& step, AgentId agent, bool before) {
  return (before || names(step.enable, agent)) && !names(step.disable, agent);
}

std::vector<StepId> next_steps(const StepDescription& step) {
  std::vector<StepId> next;
  for (const state::TriggerDescription& trigger : step.triggers) {
    if (trigger.next) next.push_back(trigger.next);
  }
  if (step.timeout_s > 0 && step.timeout_next) next.push_back(step.timeout_next);
  return next;
}

std::vector<StepId> steps_from(const state::WorldDescription& world, std::vector<StepId> open,
                               const std::function<bool(StepId)>& passes) {
  std::vector<bool> seen(world.steps.size(), false);
  std::vector<StepId> found;
  while (!open.empty()) {
    const StepId id = open.back();
    open.pop_back();
    if (seen[id.index()] || (passes && !passes(id))) continue;
    seen[id.index()] = true;
    found.push_back(id);
    const std::vector<StepId> next = next_steps(world.steps[id.index()]);
    open.insert(open.end(), next.begin(), next.end());
  }
  return found;
}

void lint(Compilation& c) {
  check_all_texts(c);
  check_reach(c);
  check_triggers(c);
  check_gauges(c);
  lint_bodies(c);
  lint_touch(c);
  check_sounds(c);
  check_visits(c);
  check_world(c);
}

}  // namespace mechane::scenario
