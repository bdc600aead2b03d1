#include "server/world/continuation.hpp"

#include <algorithm>
#include <vector>

#include "server/state/snapshot.hpp"

namespace mechane::world {
namespace {

using Kind = Obstacle::Kind;
using state::BodyDescription;
using state::StepDescription;
using state::WorldDescription;

bool same_pose(const Pose& a, const Pose& b) {
  return a.p == b.p && a.R.coeffs() == b.R.coeffs();
}

bool same_switches(const StepDescription& a, const StepDescription& b) {
  const auto same = [](const state::BodyOverride& x, const state::BodyOverride& y) {
    const bool placed_alike = x.X_WB.has_value() == y.X_WB.has_value() && (!x.X_WB || same_pose(*x.X_WB, *y.X_WB));
    return x.body == y.body && x.movable == y.movable && x.visible == y.visible && x.graspable == y.graspable &&
           x.use_gravity == y.use_gravity && placed_alike;
  };
  return a.enable == b.enable && a.disable == b.disable && std::ranges::equal(a.bodies, b.bodies, same);
}

bool begins_alike(const BodyDescription& a, const BodyDescription& b) {
  return a.fixed == b.fixed && a.driven == b.driven && a.visible == b.visible && a.graspable == b.graspable &&
         same_pose(a.X_WB, b.X_WB) && a.V_WB.v == b.V_WB.v && a.V_WB.w == b.V_WB.w;
}

/// What can be told by name.
Obstacle named_obstacle(const WorldDescription& now, const WorldDescription& next) {
  const auto same_step = [](const StepDescription& a, const StepDescription& b) {
    return a.name == b.name && a.activity == b.activity;
  };
  if (!std::ranges::equal(now.activities, next.activities, {}, &state::ActivityDescription::name,
                          &state::ActivityDescription::name) ||
      !std::ranges::equal(now.steps, next.steps, same_step))
    return {Kind::steps};
  for (std::size_t i = 0; i < now.steps.size(); ++i)
    if (!same_switches(now.steps[i], next.steps[i])) return {Kind::steps, next.steps[i].name};
  if (!std::ranges::equal(now.bodies, next.bodies, {}, &BodyDescription::name, &BodyDescription::name))
    return {Kind::bodies};
  for (std::size_t i = 0; i < now.bodies.size(); ++i)
    if (!begins_alike(now.bodies[i], next.bodies[i])) return {Kind::body, next.bodies[i].name};
  return {};
}

}  // namespace

std::string_view word_of(Kind kind) {
  switch (kind) {
    case Kind::none:
      return "none";
    case Kind::steps:
      return "steps";
    case Kind::bodies:
      return "bodies";
    case Kind::body:
      return "body";
    case Kind::start:
      return "start";
  }
  return "";
}

Expected<Obstacle> obstacle_between(const std::shared_ptr<const WorldDescription>& now,
                                    const std::shared_ptr<const WorldDescription>& next, const WorldConfig& config) {
  if (Obstacle named = named_obstacle(*now, *next); named.kind != Kind::none) return named;
  std::vector<std::byte> starts[2];
  for (const auto& [description, start] : {std::pair(now, &starts[0]), std::pair(next, &starts[1])}) {
    const auto world = World::create(description, config);
    if (!world) return tl::unexpected(world.error());
    state::write_snapshot((*world)->state, *start);
  }
  return Obstacle{starts[0] == starts[1] ? Kind::none : Kind::start};
}

}  // namespace mechane::world
