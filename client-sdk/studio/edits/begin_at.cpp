#include "client-sdk/studio/edits/begin_at.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "client-sdk/studio/edits/apply.hpp"
#include "server/base/clock.hpp"
#include "server/base/suggestion.hpp"

namespace mechane::studio {
namespace {

using state::BodyOverride;
using state::StepDescription;
using state::WorldDescription;

std::vector<StepId> next_of(const StepDescription& step) {
  std::vector<StepId> next;
  for (const state::TriggerDescription& trigger : step.triggers)
    next.push_back(trigger.next);
  if (step.timeout_s > 0) next.push_back(step.timeout_next);
  std::erase(next, StepId::none());
  return next;
}

/// The steps before `goal` on the shortest way to it, the first one first; empty where no way leads there.
std::vector<StepId> way_to(const WorldDescription& world, StepId first, StepId goal) {
  std::map<StepId, StepId> from{{first, StepId::none()}};
  std::vector<StepId> reached{first};
  for (std::size_t i = 0; i < reached.size() && !from.contains(goal); ++i) {
    const StepId at = reached[i];
    for (const StepId next : next_of(world.steps[at.index()]))
      if (from.emplace(next, at).second) reached.push_back(next);
  }
  std::vector<StepId> way;
  if (!from.contains(goal)) return way;
  for (StepId at = from[goal]; at; at = from[at])
    way.insert(way.begin(), at);
  return way;
}

/// What steps one after another leave: which agents they have switched, and how bodies are.
struct Left {
  std::map<std::string, bool> agents;
  std::map<std::string, BodyOverride> bodies;
};

Left left_by(const WorldDescription& world, const std::vector<StepId>& way) {
  Left left;
  for (const StepId id : way) {
    const StepDescription& step = world.steps[id.index()];
    for (const AgentId agent : step.enable)
      left.agents[world.agents[agent.index()].name] = true;
    for (const AgentId agent : step.disable)
      left.agents[world.agents[agent.index()].name] = false;
    for (const BodyOverride& change : step.bodies) {
      BodyOverride& body = left.bodies[world.bodies[change.body.index()].name];
      if (change.movable) body.movable = change.movable;
      if (change.visible) body.visible = change.visible;
      if (change.graspable) body.graspable = change.graspable;
      if (change.use_gravity) body.use_gravity = change.use_gravity;
      if (change.X_WB) body.X_WB = change.X_WB;
    }
  }
  return left;
}

void write_left(const Left& left, const std::string& step, std::vector<Command>& out) {
  for (const auto& [key, on] : {std::pair("enable", true), std::pair("disable", false)}) {
    std::vector<std::string> names;
    for (const auto& [agent, is_on] : left.agents)
      if (is_on == on) names.push_back(agent);
    if (!names.empty()) out.push_back(SetValue{fmt::format("{}/{}", step, key), names});
  }
  for (const auto& [name, body] : left.bodies) {
    const auto write = [&, set = fmt::format("{}/object:{}/", step, name)](const char* key, state::Parameter value) {
      out.push_back(SetValue{set + key, std::move(value)});
    };
    if (body.movable) write("movable", *body.movable);
    if (body.visible) write("visible", *body.visible);
    if (body.graspable) write("graspable", *body.graspable);
    if (body.use_gravity) write("useGlobalGravity", *body.use_gravity);
    if (!body.X_WB) continue;
    const Eigen::AngleAxisd turn(body.X_WB->R);
    write("position", std::vector{body.X_WB->p.x(), body.X_WB->p.y(), body.X_WB->p.z()});
    write("orientation", std::vector{turn.axis().x(), turn.axis().y(), turn.axis().z(), turn.angle()});
  }
}

std::vector<std::string> names_of_steps(const WorldDescription& world) {
  std::vector<std::string> names;
  for (const StepDescription& step : world.steps)
    names.push_back(fmt::format("{}/{}", world.activities[step.activity.index()].name, step.name));
  return names;
}

}  // namespace

Expected<std::string> begin_at(std::string_view text, const std::filesystem::path& path, const WorldDescription& world,
                               const std::string& step) {
  const std::vector<std::string> names = names_of_steps(world);
  const auto named = std::ranges::find(names, step);
  if (named == names.end())
    return fail(ErrorCode::unknown_name, fmt::format("no step is called '{}'", step), "step",
                suggest(step, names, "write it as ACTIVITY/STEP"));
  const StepId goal(static_cast<std::size_t>(named - names.begin()));
  const ActivityId id = world.steps[goal.index()].activity;
  const state::ActivityDescription& activity = world.activities[id.index()];
  const std::string base = "activities/" + activity.name;
  std::vector<Command> commands{ReorderSet{base, ""}};
  if (goal != activity.first) {
    const std::string& name = world.steps[goal.index()].name;
    std::string before = "before-" + name;
    while (world.find_step(before))
      before.insert(0, "before-");
    const std::string added = fmt::format("{}/steps/{}", base, before);
    commands.emplace_back(SetValue{base + "/first", std::vector{before}});
    commands.emplace_back(SetValue{added + "/timeoutSeconds", std::vector{kTickSeconds}});
    commands.emplace_back(SetValue{added + "/timeoutNext", std::vector{name}});
    write_left(left_by(world, way_to(world, activity.first, goal)), added, commands);
  }
  auto applied = apply_commands(text, path, commands);
  if (!applied) return tl::unexpected(applied.error().error);
  return std::move(applied->text);
}

}  // namespace mechane::studio
