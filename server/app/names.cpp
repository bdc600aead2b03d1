#include "server/app/names.hpp"

#include <fmt/format.h>

namespace mechane::app {
namespace {

template <class List>
std::string name_in(const List& list, std::uint32_t index) {
  return index < list.size() ? list[index].name : std::string("?");
}

}  // namespace

std::string describe_event(const state::WorldDescription& world, const state::Event& event) {
  using state::EventKind;
  const std::string body = name_in(world.bodies, event.object);
  switch (event.kind) {
    case EventKind::user_joined:
      return fmt::format("user {} joined", event.subject);
    case EventKind::user_left:
      return fmt::format("user {} left", event.subject);
    case EventKind::input_stale:
      return fmt::format("user {} is silent: the hand is frozen", event.subject);
    case EventKind::input_back:
      return fmt::format("user {} is back", event.subject);
    case EventKind::touched:
      return fmt::format("user {} touched {}", event.subject, body);
    case EventKind::grasped:
      return fmt::format("user {} grasped {}", event.subject, body);
    case EventKind::released:
      return fmt::format("user {} released {}", event.subject, body);
    case EventKind::placed:
      return fmt::format("{} placed by {}", body, name_in(world.agents, event.subject));
    case EventKind::turned:
      return fmt::format("{}: {:.0f} turns", name_in(world.agents, event.subject), event.value);
    case EventKind::step_started:
      return fmt::format("step {} started", name_in(world.steps, event.subject));
    case EventKind::activity_started:
      return fmt::format("activity {} started", name_in(world.activities, event.subject));
    case EventKind::activity_done:
      return fmt::format("activity {} done in {:.1f} s", name_in(world.activities, event.subject), event.value);
    case EventKind::spilled:
      return fmt::format("{} spilled {:.1f} l", name_in(world.machines, event.subject), 1000 * event.value);
    case EventKind::command_done:
      return fmt::format("command {:.0f} done", event.value);
    case EventKind::command_refused:
      return fmt::format("command {:.0f} refused", event.value);
    case EventKind::pulled:
      return fmt::format("{}: {} pulled", name_in(world.agents, event.subject), body);
    case EventKind::pushed:
      return fmt::format("{}: {} pushed", name_in(world.agents, event.subject), body);
    case EventKind::lit:
      return fmt::format("{}: {} lit", name_in(world.agents, event.subject), body);
    case EventKind::fired:
      return fmt::format("{}: {} fired", name_in(world.agents, event.subject), body);
    case EventKind::assembled:
      return fmt::format("{}: assembled", name_in(world.agents, event.subject));
    case EventKind::part_refused:
      return fmt::format("{}: {} came before its turn", name_in(world.agents, event.subject), body);
    case EventKind::dwelt:
      return fmt::format("{}: stayed for {:.1f} s", name_in(world.agents, event.subject), event.value);
    case EventKind::pointed:
      return fmt::format("{}: user {:.0f} points at {}", name_in(world.agents, event.subject), event.value, body);
    case EventKind::idled:
      return fmt::format("{}: nothing happened for {:.0f} s", name_in(world.agents, event.subject), event.value);
    case EventKind::broke:
      return fmt::format("{}: broke at {:.1f}", name_in(world.agents, event.subject), event.value);
    case EventKind::none:
      break;
  }
  return "nothing";
}

}  // namespace mechane::app
