// Activities and their steps, in two passes, so that a trigger may name a later step.
#include <algorithm>

#include <fmt/format.h>

#include "server/agents/joint_switch.hpp"
#include "server/base/suggestion.hpp"
#include "server/scenario/compilation.hpp"

namespace mechane::scenario {
namespace {

/// One activity as written, with the ids that its steps get.
struct Written {
  ActivityId id;
  Fields fields;
  std::vector<const x3d::Metadata*> steps;
  std::size_t first_step = 0;

  [[nodiscard]] StepId find(const std::string& name) const {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (steps[i]->name == name) return StepId(first_step + i);
    }
    return StepId::none();
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const x3d::Metadata* step : steps)
      names.push_back(step->name);
    return names;
  }
};

void collect_steps(Compilation& c, Written& activity) {
  activity.first_step = c.world.steps.size();
  const x3d::Metadata* steps = activity.fields.set("steps");
  if (steps == nullptr) return;
  for (const x3d::Metadata& step : steps->children) {
    const std::string where = "step " + step.name;
    if (step.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, step.line, where, "the step is not a set", "write a MetadataSet");
    } else if (step.name.empty() || step.name == "end") {
      c.problems.error(ErrorCode::invalid_value, step.line, where,
                       fmt::format("a step cannot be called '{}'", step.name),
                       "use another name, for example what the visitor does: 'turn'");
    } else if (c.world.find_step(step.name)) {
      c.problems.error(ErrorCode::duplicate, step.line, where, "another activity has a step of this name",
                       "give one of them another name");
    } else {
      activity.steps.push_back(&step);
      state::StepDescription description;
      description.name = step.name;
      description.activity = activity.id;
      c.world.steps.push_back(std::move(description));
      c.step_lines.push_back(step.line);
    }
  }
  if (activity.steps.empty())
    c.problems.error(ErrorCode::missing, activity.fields.line("steps"), activity.fields.where(),
                     "the activity has no steps", "add one");
}

std::vector<AgentId> read_agents(Compilation& c, const Fields& fields, std::string_view key) {
  std::vector<AgentId> agents;
  for (const std::string& name : fields.strings(key)) {
    const AgentId agent = c.world.find_agent(name);
    if (agent) {
      agents.push_back(agent);
    } else if (c.world.find_joint(name)) {
      c.problems.error(ErrorCode::missing, fields.line(key), fields.where(),
                       fmt::format("the joint '{}' has no agent to switch", name),
                       "put a 'mechane:agent' set on it, like geometry.hinge");
    } else {
      report_unknown(c, {fields.where(), fields.line(key)}, "agent", name, names_of(c.world.agents),
                     "add it to the scenario's agents");
    }
  }
  return agents;
}

std::optional<bool> optional_boolean(const Fields& fields, std::string_view key) {
  return fields.given(key) ? std::optional<bool>(fields.boolean(key)) : std::nullopt;
}

/// A step that gives a body weight, where there is nothing to pull it or nothing that can fall.
void check_weight(Compilation& c, const Fields& fields, const state::BodyOverride& change,
                  const state::BodyDescription& body) {
  if (!change.use_gravity.value_or(false)) return;
  if (body.fixed)
    c.problems.error(ErrorCode::conflict, fields.line("useGlobalGravity"), fields.where(),
                     "the body is fixed and cannot fall", "remove fixed='true' of the RigidBody");
  else if (c.world.gravity_W.isZero())
    c.problems.warning(ErrorCode::conflict, fields.line("useGlobalGravity"), fields.where(),
                       "the body gets no weight: the gravity of the RigidBodyCollection is 0 0 0",
                       "write gravity='0 -9.81 0' there, and useGlobalGravity='false' on what floats");
}

state::BodyOverride read_override(Compilation& c, const Fields& fields, int line, BodyId id) {
  state::BodyOverride change;
  change.body = id;
  const state::BodyDescription& body = c.world.bodies[id.index()];
  change.movable = optional_boolean(fields, "movable");
  change.visible = optional_boolean(fields, "visible");
  change.graspable = optional_boolean(fields, "graspable");
  change.use_gravity = optional_boolean(fields, "useGlobalGravity");
  if (change.movable.value_or(false) && body.fixed) {
    c.problems.error(ErrorCode::conflict, fields.line("movable"), fields.where(),
                     "the body is fixed and cannot be made movable", "remove fixed='true' of the RigidBody");
  }
  check_weight(c, fields, change, body);
  if (fields.given("position") || fields.given("orientation")) {
    change.X_WB = body.X_WB;
    if (fields.given("position")) change.X_WB->p = fields.vector("position");
    if (fields.given("orientation")) change.X_WB->R = fields.rotation("orientation");
    if (body.fixed)
      c.problems.error(ErrorCode::conflict, line, fields.where(), "the body is fixed and cannot be moved",
                       "remove fixed='true' of the RigidBody");
  }
  return change;
}

/// What is said of a body twice, once of all copies and once of this one, is added up; the later counts.
void add_override(const state::BodyOverride& change, state::StepDescription& out) {
  const auto known = std::ranges::find(out.bodies, change.body, &state::BodyOverride::body);
  if (known == out.bodies.end()) {
    out.bodies.push_back(change);
    return;
  }
  if (change.movable) known->movable = change.movable;
  if (change.visible) known->visible = change.visible;
  if (change.graspable) known->graspable = change.graspable;
  if (change.use_gravity) known->use_gravity = change.use_gravity;
  if (change.X_WB) known->X_WB = change.X_WB;
}

void read_overrides(Compilation& c, const x3d::Metadata& set, const std::string& step, state::StepDescription& out) {
  const std::string name = set.name.substr(std::string_view("object:").size());
  const Fields fields(&set, override_table(), fmt::format("{}, object {}", step, name), c.problems);
  const std::vector<std::string> names = all_copies(c, name);
  if (names.size() > 1 && (fields.given("position") || fields.given("orientation"))) {
    c.problems.error(ErrorCode::conflict, set.line, fields.where(), "it would put all copies at one place",
                     fmt::format("write a set object:{} for each, with its place", names.front()));
    return;
  }
  std::optional<state::BodyOverride> change;
  for (const std::string& one : names) {
    const BodyId body = find_body(c, one, {fields.where(), set.line});
    if (!body) return;
    if (!change) change = read_override(c, fields, set.line, body);
    change->body = body;
    add_override(*change, out);
  }
}

state::Comparison comparison_of(const std::string& op) {
  if (op == "<") return state::Comparison::less;
  return op == "=" ? state::Comparison::equal : state::Comparison::greater;
}

/// Reads a rule from its own set, or from a trigger that holds one comparison itself.
state::RuleDescription read_rule(Compilation& c, const Fields& fields, StepId step, bool marked) {
  state::RuleDescription rule;
  rule.quantity = find_quantity(c, fields);
  rule.comparison = comparison_of(fields.string("op"));
  rule.value = fields.number("value");
  rule.tolerance = fields.number("tolerance");
  if (rule.quantity && fields.given("op") && fields.given("value"))
    c.rules.push_back({fields.line("value"), fields.where(), step, rule, marked});
  return rule;
}

StepId read_next(Compilation& c, const Written& activity, const Fields& fields, std::string_view key) {
  const std::string next = fields.string(key);
  const StepId step = activity.find(next);
  if (next != "end" && !step) {
    std::vector<std::string> names = activity.names();
    names.emplace_back("end");
    c.problems.error(ErrorCode::unknown_name, fields.line(key), fields.where(),
                     fmt::format("the activity has no step '{}'", next),
                     suggest(next, names, "name one of its steps, or end"));
  }
  return step;
}

void read_trigger(Compilation& c, const Written& activity, const x3d::Metadata& set, const std::string& step,
                  state::StepDescription& out, StepId id) {
  const Fields fields(&set, trigger_table(), fmt::format("{}, {}", step, set.name), c.problems);
  std::vector<state::RuleDescription> rules;
  const bool marked = out.triggers.empty();
  const bool several = !fields.sets_like("rule:*").empty();
  if (set.find("quantity") != nullptr || set.find("op") != nullptr || set.find("value") != nullptr) {
    for (const char* key : {"quantity", "op", "value"}) {
      if (set.find(key) != nullptr || !several) continue;  // without rules the table has reported it
      c.problems.error(ErrorCode::missing, set.line, fields.where(), fmt::format("the key '{}' is missing", key),
                       "add it: a trigger compares quantity, op and value; or write all three into a rule:1");
    }
    rules.push_back(read_rule(c, fields, id, marked));
  }
  for (const x3d::Metadata* rule : fields.sets_like("rule:*")) {
    const Fields of_rule(rule, rule_table(), fmt::format("{}, {}", fields.where(), rule->name), c.problems);
    rules.push_back(read_rule(c, of_rule, id, marked));
  }
  if (rules.size() < 2 && fields.given("match")) {
    c.problems.warning(ErrorCode::conflict, fields.line("match"), fields.where(),
                       "match has no effect: the trigger has one rule",
                       "remove match, or write the comparisons as rule:1, rule:2");
  }
  state::TriggerDescription trigger;
  if (!rules.empty()) {
    trigger.quantity = rules.front().quantity;
    trigger.comparison = rules.front().comparison;
    trigger.value = rules.front().value;
    trigger.tolerance = rules.front().tolerance;
    trigger.more.assign(rules.begin() + 1, rules.end());
  }
  trigger.any = fields.string("match") == "any";
  trigger.hold_s = fields.number("holdSeconds");
  trigger.next = read_next(c, activity, fields, "next");
  out.triggers.push_back(std::move(trigger));
}

void read_timeout(Compilation& c, const Written& activity, const Fields& fields, state::StepDescription& step) {
  step.timeout_s = fields.number("timeoutSeconds");
  if (step.timeout_s > 0) {
    step.timeout_next = read_next(c, activity, fields, "timeoutNext");
  } else if (fields.given("timeoutNext")) {
    c.problems.warning(ErrorCode::conflict, fields.line("timeoutNext"), fields.where(),
                       "timeoutNext has no effect: the step has no timeoutSeconds", "add timeoutSeconds, or remove it");
  }
}

/// Sound files are named by a path relative to the scenario file: a museum may have no network.
void check_audio(Compilation& c, const Fields& fields, state::StepDescription& step) {
  const auto audio = step.texts.find("audio");
  if (audio == step.texts.end()) return;
  const x3d::Metadata* set = fields.set("text");
  for (auto it = audio->second.begin(); it != audio->second.end();) {
    const x3d::Metadata* written = set->find("audio." + it->first);
    if (x3d::is_relative_path(it->second)) {
      ++it;
      continue;
    }
    c.problems.error(
        ErrorCode::invalid_value, written->line, fields.where(), fmt::format("'{}' is not a relative path", it->second),
        "copy the sound into the scenario's folder, and name it by its path from this file, like audio/turn.en.ogg");
    it = audio->second.erase(it);
  }
}

void read_detail(Compilation& c, const Fields& fields, state::StepDescription& step) {
  step.detail = fields.string("detail");
  const auto& views = c.world.viewpoints;
  const auto named = [&](const state::Viewpoint& view) { return view.name == step.detail; };
  if (step.detail.empty() || std::any_of(views.begin(), views.end(), named)) return;
  report_unknown(c, {fields.where(), fields.line("detail")}, "Viewpoint", step.detail, names_of(views),
                 "add a Viewpoint of that DEF");
}

void compile_step(Compilation& c, const Written& activity, const x3d::Metadata& set) {
  const std::string where = "step " + set.name;
  const Fields fields(&set, step_table(), where, c.problems);
  state::StepDescription& step = c.world.steps[activity.find(set.name).index()];
  step.enable = read_agents(c, fields, "enable");
  step.disable = read_agents(c, fields, "disable");
  for (const AgentId agent : step.enable) {
    if (std::find(step.disable.begin(), step.disable.end(), agent) == step.disable.end()) continue;
    c.problems.error(ErrorCode::conflict, fields.line("disable"), where,
                     fmt::format("'{}' is both enabled and disabled", c.world.agents[agent.index()].name), "keep one");
  }
  for (const x3d::Metadata* change : fields.sets_like("object:*"))
    read_overrides(c, *change, where, step);
  for (const x3d::Metadata* trigger : fields.sets_like("trigger:*"))
    read_trigger(c, activity, *trigger, where, step, activity.find(set.name));
  read_timeout(c, activity, fields, step);
  read_detail(c, fields, step);
  step.opens = fields.string("opens");
  if (fields.given("opens") && !is_id(step.opens)) {
    c.problems.error(ErrorCode::invalid_value, fields.line("opens"), where,
                     fmt::format("'{}' cannot be a scenario's id", step.opens.substr(0, 80)),
                     "write the other scenario's id, which is not the name of its file: \"archimedes-screw\"");
  }
  step.texts = read_texts(c, fields.set("text"), where + ", text", "caption narration hint audio");
  check_audio(c, fields, step);
  step.hint_after_s = fields.number("hintSeconds");
}

void compile_first(Compilation& c, const Written& activity) {
  state::ActivityDescription& description = c.world.activities[activity.id.index()];
  if (activity.steps.empty()) return;
  description.first = StepId(activity.first_step);
  if (!activity.fields.given("first")) return;
  const std::string first = activity.fields.string("first");
  description.first = activity.find(first);
  if (!description.first) {
    c.problems.error(ErrorCode::unknown_name, activity.fields.line("first"), activity.fields.where(),
                     fmt::format("the activity has no step '{}'", first),
                     suggest(first, activity.names(), "name one of its steps"));
  }
}

/// A step opens the other scenario as it begins, and an activity's first step begins before any visitor is there.
void check_first(Compilation& c, const Written& activity) {
  const StepId first = c.world.activities[activity.id.index()].first;
  if (!first || c.world.steps[first.index()].opens.empty()) return;
  const std::string& name = c.world.steps[first.index()].name;
  c.problems.error(ErrorCode::conflict, c.step_lines[first.index()], "step " + name,
                   "the activity's first step cannot open another scenario", "let a later step open it");
}

/// A joint whose agent some step enables is off at the start, as its agent is.
void open_switched_joints(state::WorldDescription& world) {
  for (const state::StepDescription& step : world.steps) {
    for (const AgentId agent : step.enable) {
      const JointId joint = agents::switched_joint(world, world.agents[agent.index()]);
      if (joint) world.joints[joint.index()].enabled_at_start = false;
    }
  }
}

}  // namespace

void compile_activities(Compilation& c) {
  const x3d::Metadata* tree = tree_set(c, "activities");
  if (tree == nullptr) return;
  std::vector<Written> written;
  for (const x3d::Metadata& set : tree->children) {
    const std::string where = "activity " + set.name;
    if (set.kind != x3d::MetadataKind::set) {
      c.problems.error(ErrorCode::invalid_value, set.line, where, "the activity is not a set", "write a MetadataSet");
      continue;
    }
    Written activity{ActivityId(c.world.activities.size()), Fields(&set, activity_table(), where, c.problems), {}, 0};
    state::ActivityDescription description;
    description.name = set.name;
    auto texts = read_texts(c, activity.fields.set("text"), where + ", text", "title goal");
    description.title = std::move(texts["title"]);
    description.goal = std::move(texts["goal"]);
    description.questionnaire = read_questionnaire(c, activity.fields);
    c.world.activities.push_back(std::move(description));
    c.activity_lines.push_back(set.line);
    collect_steps(c, activity);
    written.push_back(std::move(activity));
  }
  if (tree->children.empty())
    c.problems.error(ErrorCode::missing, tree->line, "activities", "the scenario has no activity",
                     "add one with its steps");
  for (const Written& activity : written) {
    for (const x3d::Metadata* step : activity.steps)
      compile_step(c, activity, *step);
    compile_first(c, activity);
    check_first(c, activity);
  }
  open_switched_joints(c.world);
}

}  // namespace mechane::scenario
