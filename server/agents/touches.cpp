#include "server/agents/touches.hpp"

#include <algorithm>

namespace mechane::agents {
namespace {

constexpr double kApart_s = 0.25;  // contacts closer in time than this are one touch: a finger trembles on the surface

}  // namespace

Touches::Touches(const state::WorldDescription& description, state::MemoryLayout& layout) {
  for (std::size_t u = 0; u < hand::kMaxUsers; ++u) {
    for (std::size_t b = 0; b < description.bodies.size(); ++b) {
      if (description.bodies[b].object == nullptr) continue;
      const std::string value = "user" + std::to_string(u) + "." + description.bodies[b].name;
      watches_.push_back({u, BodyId(b), layout.add("touch", value, kApart_s)});
    }
  }
}

void Touches::run(state::WorldState& state, double dt_s) const noexcept {
  for (const Watch& watch : watches_) {
    const state::UserState& user = state.users[watch.user];
    double& since_s = state.memory[watch.since_s];
    const bool touching = user.present && user.touches(watch.body);
    if (touching && since_s >= kApart_s) {
      state.emit(state::EventKind::touched, static_cast<std::uint32_t>(watch.user),
                 static_cast<std::uint32_t>(watch.body.index()));
    }
    since_s = touching ? 0 : std::min(since_s + dt_s, kApart_s);
  }
}

}  // namespace mechane::agents
