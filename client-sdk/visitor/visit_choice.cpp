#include <algorithm>

#include <fmt/format.h>

#include "client-sdk/visitor/visit_session.hpp"

namespace mechane::visitor {
namespace {

using state::VisitDescription;
using state::WorldDescription;

/// "assembling (activity assemble), using (activity use)".
std::string listed(const WorldDescription& world) {
  std::string list;
  for (const VisitDescription& visit : world.visits) {
    list += fmt::format("{}{} (activity {})", list.empty() ? "" : ", ", visit.name,
                        world.activities[visit.activity.index()].name);
  }
  return list;
}

}  // namespace

Expected<std::vector<const VisitDescription*>> choose_visits(const VisitOptions& options,
                                                             const WorldDescription& world) {
  const std::string file = options.scenario.string();
  if (world.visits.empty())
    return fail(ErrorCode::missing, "the scenario has no visit to play", file,
                "write one (see scenarios/REFERENCE.md)");
  std::vector<const VisitDescription*> chosen;
  const auto choose = [&](const std::string& what, const std::string& name, auto&& is_it) -> Expected<void> {
    const auto visit = std::ranges::find_if(world.visits, is_it);
    if (visit == world.visits.end())
      return fail(ErrorCode::unknown_name, fmt::format("the scenario has no {} '{}'", what, name), file,
                  "choose one of its visits: " + listed(world));
    chosen.push_back(&*visit);
    return {};
  };
  for (const std::string& name : options.visits) {
    auto found = choose("visit", name, [&](const auto& visit) { return visit.name == name; });
    if (!found) return tl::unexpected(found.error());
  }
  for (const std::string& name : options.activities) {
    const ActivityId id = world.find_activity(name);
    if (!id && std::ranges::find(world.visits, name, &VisitDescription::name) != world.visits.end())
      return fail(ErrorCode::unknown_name, fmt::format("'{}' is a visit, not an activity", name), file,
                  fmt::format("write --visit {}", name));
    auto found = choose("visit of an activity", name, [&](const auto& visit) { return id && visit.activity == id; });
    if (!found) return tl::unexpected(found.error());
  }
  if (chosen.empty()) {
    for (const VisitDescription& visit : world.visits)
      chosen.push_back(&visit);
  }
  return chosen;
}

}  // namespace mechane::visitor
