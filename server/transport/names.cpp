#include "server/transport/names.hpp"

#include <fmt/format.h>

namespace mechane::transport {
namespace {

template <class Item>
std::string name_at(const std::vector<Item>& items, std::uint32_t index) {
  return index < items.size() ? items[index].name : std::string();
}

}  // namespace

std::string user_name(const std::array<HandSnapshot, hand::kMaxUsers>& hands, std::uint32_t slot) {
  if (slot >= hands.size()) return {};
  const SlotName& name = hands[slot].name;
  if (name.session == 0) return fmt::format("user {}", slot);
  return fmt::format("{}/{}", name.kiosk.data(), name.user);
}

EventNames names_of(const state::WorldDescription& world, const state::Event& event,
                    const std::array<HandSnapshot, hand::kMaxUsers>& hands) {
  using Kind = state::EventKind;
  const std::string user = user_name(hands, event.subject);
  switch (event.kind) {
    case Kind::user_joined:
      return {"user_joined", user, {}};
    case Kind::user_left:
      return {"user_left", user, {}};
    case Kind::input_stale:
      return {"input_stale", user, {}};
    case Kind::input_back:
      return {"input_back", user, {}};
    case Kind::touched:
      return {"touched", user, name_at(world.bodies, event.object)};
    case Kind::grasped:
      return {"grasped", user, name_at(world.bodies, event.object)};
    case Kind::released:
      return {"released", user, name_at(world.bodies, event.object)};
    case Kind::placed:
      return {"placed", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::turned:
      return {"turned", name_at(world.agents, event.subject), {}};
    case Kind::step_started:
      return {"step_started", name_at(world.steps, event.subject), {}};
    case Kind::activity_started:
      return {"activity_started", name_at(world.activities, event.subject), {}};
    case Kind::activity_done:
      return {"activity_done", name_at(world.activities, event.subject), {}};
    case Kind::spilled:
      return {"spilled", name_at(world.machines, event.subject), {}};
    case Kind::command_done:
      return {"command_done", {}, {}};
    case Kind::command_refused:
      return {"command_refused", {}, {}};
    case Kind::pulled:
      return {"pulled", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::pushed:
      return {"pushed", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::lit:
      return {"lit", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::fired:
      return {"fired", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::assembled:
      return {"assembled", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::part_refused:
      return {"part_refused", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::dwelt:
      return {"dwelt", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::pointed:
      return {"pointed", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::idled:
      return {"idled", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::broke:
      return {"broke", name_at(world.agents, event.subject), name_at(world.bodies, event.object)};
    case Kind::none:
      break;
  }
  return {"none", {}, {}};
}

}  // namespace mechane::transport
