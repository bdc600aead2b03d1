#include "server/agents/progress.hpp"

#include <algorithm>
#include <cmath>

#include "server/agents/agent.hpp"
#include "server/base/assert.hpp"
#include "server/base/clock.hpp"

namespace mechane::agents {
namespace {

using state::EventKind;

template <class Tag>
bool in_table(Id<Tag> id, std::size_t size) {
  return id && id.index() < size;
}

Expected<void> check_step(const state::WorldDescription& world, const state::StepDescription& step) {
  const std::string where = "step " + step.name;
  for (const auto* list : {&step.enable, &step.disable}) {
    for (const AgentId agent : *list) {
      if (!in_table(agent, world.agents.size()))
        return fail(ErrorCode::unknown_name, "it switches an agent that does not exist", where, "name an agent");
    }
  }
  for (const state::BodyOverride& change : step.bodies) {
    if (!in_table(change.body, world.bodies.size()))
      return fail(ErrorCode::unknown_name, "it changes a body that does not exist", where, "name a body");
  }
  for (const state::TriggerDescription& trigger : step.triggers) {
    if (!in_table(trigger.quantity, world.quantities.size()))
      return fail(ErrorCode::unknown_name, "a trigger tests a quantity that does not exist", where, "name a quantity");
    if (trigger.next && !in_table(trigger.next, world.steps.size()))
      return fail(ErrorCode::unknown_name, "a trigger leads to a step that does not exist", where,
                  "name a step, or 'end'");
    if (!std::isfinite(trigger.value) || !(trigger.hold_s >= 0))
      return fail(ErrorCode::invalid_value, "a trigger's value is not a number, or its hold time is negative", where,
                  "write a number for the value, and 0 s or more for the time");
    for (const state::RuleDescription& rule : trigger.more) {
      if (!in_table(rule.quantity, world.quantities.size()))
        return fail(ErrorCode::unknown_name, "a trigger tests a quantity that does not exist", where,
                    "name a quantity");
      if (!std::isfinite(rule.value))
        return fail(ErrorCode::invalid_value, "a rule's value is not a number", where, "write a number");
    }
  }
  if (!(step.timeout_s >= 0))
    return fail(ErrorCode::invalid_value, "its time-out is negative or not a number", where, "write 0 s or more");
  if (step.timeout_next && !in_table(step.timeout_next, world.steps.size()))
    return fail(ErrorCode::unknown_name, "its time-out leads to a step that does not exist", where,
                "name a step, or 'end'");
  return {};
}

bool holds(const state::RuleDescription& rule, const std::vector<double>& quantities) {
  const double quantity = quantities[rule.quantity.index()];
  switch (rule.comparison) {
    case state::Comparison::less:
      return quantity < rule.value;
    case state::Comparison::equal:
      return std::abs(quantity - rule.value) <= rule.tolerance;
    case state::Comparison::greater:
      return quantity > rule.value;
  }
  return false;
}

bool holds(const state::TriggerDescription& trigger, const std::vector<double>& quantities) {
  const bool first =
      holds(state::RuleDescription{trigger.quantity, trigger.comparison, trigger.value, trigger.tolerance}, quantities);
  if (first == trigger.any) return first;
  for (const state::RuleDescription& rule : trigger.more) {
    if (holds(rule, quantities) == trigger.any) return trigger.any;
  }
  return !trigger.any;
}

double seconds_since(const state::WorldState& state, std::uint64_t tick) {
  return static_cast<double>(state.tick - tick) * kTickSeconds;
}

template <class Tag>
std::uint32_t subject(Id<Tag> id) {
  return static_cast<std::uint32_t>(id.index());
}

}  // namespace

Expected<ProgressRules> ProgressRules::create(const state::WorldDescription& description, state::MemoryLayout& layout) {
  for (const state::ActivityDescription& activity : description.activities) {
    if (!in_table(activity.first, description.steps.size()))
      return fail(ErrorCode::missing, "it has no first step", "activity " + activity.name,
                  "name the step that it begins with");
  }
  ProgressRules out;
  out.description_ = &description;
  const state::WorldState at_start(description);
  out.bodies_ = at_start.bodies;
  out.joints_ = at_start.joints;
  out.agent_enabled_.assign(description.agents.size(), 1);
  for (const state::StepDescription& step : description.steps) {
    if (auto good = check_step(description, step); !good) return tl::unexpected(good.error());
    for (const AgentId agent : step.enable)
      out.agent_enabled_[agent.index()] = 0;
    out.first_hold_.push_back(layout.slots().size());
    for (std::size_t i = 0; i < step.triggers.size(); ++i)
      layout.add("step." + step.name, "trigger" + std::to_string(i) + ".held_s");
  }
  return out;
}

void ProgressRules::start(state::WorldState& state) const noexcept {
  put_back(state);
  if (!description_->activities.empty()) start_activity(state, ActivityId(0));
}

void ProgressRules::put_back(state::WorldState& state) const noexcept {
  MECHANE_ASSERT(state.memory.size() == memory_.size());
  for (std::size_t u = 0; u < state.users.size(); ++u)
    let_go(state, u);
  std::copy(bodies_.begin(), bodies_.end(), state.bodies.begin());
  std::copy(joints_.begin(), joints_.end(), state.joints.begin());
  std::copy(agent_enabled_.begin(), agent_enabled_.end(), state.agent_enabled.begin());
  std::copy(memory_.begin(), memory_.end(), state.memory.begin());
  state.progress = {};
}

void ProgressRules::start_activity(state::WorldState& state, ActivityId activity) const noexcept {
  put_back(state);
  state.progress.activity = activity;
  state.progress.activity_tick = state.tick;
  state.emit(EventKind::activity_started, subject(activity));
  enter_step(state, description_->activities[activity.index()].first);
}

void ProgressRules::enter_step(state::WorldState& state, StepId id) const noexcept {
  const state::StepDescription& step = description_->steps[id.index()];
  state.progress.step = id;
  state.progress.step_tick = state.tick;
  state.progress.hint_shown = false;
  for (const AgentId agent : step.enable)
    state.agent_enabled[agent.index()] = 1;
  for (const AgentId agent : step.disable)
    state.agent_enabled[agent.index()] = 0;
  for (const state::BodyOverride& change : step.bodies) {
    state::BodyState& body = state[change.body];
    if (change.movable) body.movable = *change.movable;
    if (change.visible) body.visible = *change.visible;
    if (change.graspable) body.graspable = *change.graspable;
    if (change.use_gravity) body.use_gravity = *change.use_gravity;
    if (!change.X_WB) continue;
    for (std::size_t u = 0; u < state.users.size(); ++u) {
      if (state.users[u].holds(change.body)) let_go(state, u);
    }
    body.X_WB = *change.X_WB;
    body.V_WB = {};
  }
  for (std::size_t i = 0; i < step.triggers.size(); ++i)
    state.memory[first_hold_[id.index()] + i] = 0;
  state.emit(EventKind::step_started, subject(id));
}

void ProgressRules::leave_step(state::WorldState& state, StepId next) const noexcept {
  ++state.progress.steps_done;
  if (next) return enter_step(state, next);
  state.progress.done = true;
  state.emit(EventKind::activity_done, subject(state.progress.activity), 0xffffffffu,
             seconds_since(state, state.progress.activity_tick));
}

bool ProgressRules::run_command(state::WorldState& state, const state::Command& command) const noexcept {
  const state::Progress& at = state.progress;
  switch (command.kind) {
    case state::CommandKind::start_activity:
      if (command.argument >= description_->activities.size()) return false;
      start_activity(state, ActivityId(command.argument));
      return true;
    case state::CommandKind::restart_activity:
      if (!at.activity) return false;
      start_activity(state, at.activity);
      return true;
    case state::CommandKind::next_step: {
      if (!at.step || at.done) return false;
      const state::StepDescription& step = description_->steps[at.step.index()];
      leave_step(state, step.triggers.empty() ? step.timeout_next : step.triggers.front().next);
      return true;
    }
    case state::CommandKind::none:
    case state::CommandKind::click:
      break;
  }
  return false;
}

void ProgressRules::run_triggers(state::WorldState& state, double dt_s) const noexcept {
  state::Progress& at = state.progress;
  if (!at.step || at.done) return;
  const state::StepDescription& step = description_->steps[at.step.index()];
  if (seconds_since(state, at.step_tick) >= step.hint_after_s) at.hint_shown = true;
  for (std::size_t i = 0; i < step.triggers.size(); ++i) {
    const state::TriggerDescription& trigger = step.triggers[i];
    double& held_s = state.memory[first_hold_[at.step.index()] + i];
    const bool now = holds(trigger, state.quantities);
    held_s = now ? held_s + dt_s : 0;
    // Half a tick of slack, so that rounding in the sum of ticks does not make it a tick late.
    if (now && held_s + 0.5 * dt_s >= trigger.hold_s) return leave_step(state, trigger.next);
  }
  // Triggers come before the time-out: a goal that is reached in the last tick counts.
  if (step.timeout_s > 0 && seconds_since(state, at.step_tick) + 0.5 * dt_s >= step.timeout_s)
    leave_step(state, step.timeout_next);
}

}  // namespace mechane::agents
