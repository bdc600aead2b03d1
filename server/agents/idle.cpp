// simulation.idle: no hand has moved or touched anything for a while.
#include <algorithm>
#include <cmath>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

class Idle final : public Agent {
 public:
  explicit Idle(const Build& build)
      : id_(build.id),
        time_s_(build.parameters.number("time")),
        speed_m_per_s_(build.parameters.number("speed")),
        turn_rad_per_s_(build.parameters.number("turn")),
        idle_(build.slot("idle")),
        time_(build.slot("time")) {}

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const bool busy = std::any_of(state.users.begin(), state.users.end(), [&](const state::UserState& user) {
      if (!user.present || user.stale) return false;
      return user.contact_count > 0 || user.side_count > 0 || user.grasp.active ||
             user.V_WH.v.norm() > speed_m_per_s_ || user.V_WH.w.norm() > turn_rad_per_s_;
    });
    state.memory[time_] = enabled && !busy ? state.memory[time_] + dt_s : 0;
    const bool idle = enabled && !busy && state.memory[time_] + 0.5 * dt_s >= time_s_;
    if (idle && state.memory[idle_] == 0) {
      state.emit(state::EventKind::idled, static_cast<std::uint32_t>(id_.index()), 0xffffffffu, state.memory[time_]);
    }
    state.memory[idle_] = idle ? 1 : 0;
  }

 private:
  AgentId id_;
  double time_s_;
  double speed_m_per_s_;
  double turn_rad_per_s_;
  std::size_t idle_;
  std::size_t time_;
};

Expected<std::unique_ptr<Agent>> make_idle(const Build& build) {
  return std::make_unique<Idle>(build);
}

constexpr state::ParameterType kIdleParameters[] = {
    {.name = "time", .unit = "s", .summary = "after how long", .required = true, .min = 0.1, .max = 3600},
    {.name = "speed",
     .unit = "m/s",
     .summary = "a hand that is slower than this does not move: people tremble",
     .default_value = 0.03,
     .min = 0,
     .max = 10},
    {.name = "turn",
     .unit = "rad/s",
     .summary = "the same for its rotation",
     .default_value = 0.3,
     .min = 0,
     .max = 50},
};
constexpr state::ValueType kIdleValues[] = {
    state::yes_or_no("idle", "1 while nothing has happened for that long"),
    state::amount("time", "s", "since something happened"),
};

}  // namespace

const AgentKind& idle_kind() {
  static const AgentKind kKind{
      {"simulation.idle", "No hand has moved or touched anything for a while", kIdleParameters, kIdleValues},
      make_idle};
  return kKind;
}

}  // namespace mechane::agents
