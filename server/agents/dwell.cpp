// simulation.dwell: a hand, or a body, stays at a place for a while.
#include <algorithm>

#include "server/agents/agent.hpp"

namespace mechane::agents {
namespace {

using state::ParameterKind;

class Dwell final : public Agent {
 public:
  explicit Dwell(const Build& build)
      : id_(build.id),
        body_(build.parameters.body("body")),
        at_(build.parameters.body("at")),
        p_AQ_(build.vector("position")),
        radius_m_(build.parameters.number("radius")),
        time_s_(build.parameters.number("time")),
        dwelt_(build.slot("dwelt")),
        inside_(build.slot("inside")),
        time_(build.slot("time")) {}

  void run(state::WorldState& state, bool enabled, double dt_s) const noexcept override {
    const Vec3 p_WQ = at_ ? state[at_].X_WB * p_AQ_ : p_AQ_;
    const auto near = [&](const Vec3& p) { return (p - p_WQ).norm() <= radius_m_; };
    const bool inside =
        enabled && (body_ ? near(state[body_].X_WB.p)
                          : std::any_of(state.users.begin(), state.users.end(), [&](const state::UserState& user) {
                              return user.present && !user.stale && near(user.X_WH.p);
                            }));
    state.memory[inside_] = inside ? 1 : 0;
    state.memory[time_] = inside ? state.memory[time_] + dt_s : 0;
    const bool long_enough = inside && state.memory[time_] + 0.5 * dt_s >= time_s_;
    if (long_enough && state.memory[dwelt_] == 0) {
      state.emit(state::EventKind::dwelt, static_cast<std::uint32_t>(id_.index()),
                 body_ ? static_cast<std::uint32_t>(body_.index()) : 0xffffffffu, state.memory[time_]);
    }
    state.memory[dwelt_] = long_enough ? 1 : 0;
  }

 private:
  AgentId id_;
  BodyId body_;
  BodyId at_;
  Vec3 p_AQ_;
  double radius_m_;
  double time_s_;
  std::size_t dwelt_;
  std::size_t inside_;
  std::size_t time_;
};

Expected<std::unique_ptr<Agent>> make_dwell(const Build& build) {
  if (build.parameters.given("body") && build.parameters.body("body") == build.parameters.body("at"))
    return fail(ErrorCode::conflict, "'body' and 'at' name the same body", build.place("at"),
                "name another body in 'at', or none for the world");
  return std::make_unique<Dwell>(build);
}

constexpr state::ParameterType kDwellParameters[] = {
    {.name = "at",
     .kind = ParameterKind::text,
     .summary = "the body in whose frame the place is; none: the world",
     .reference = state::Reference::body},
    state::point("position", "the place's middle"),
    {.name = "radius", .unit = "m", .summary = "how close counts", .required = true, .min = 0.001, .max = 100},
    {.name = "time", .unit = "s", .summary = "how long it must stay", .default_value = 1, .min = 0, .max = 3600},
    {.name = "body",
     .kind = ParameterKind::text,
     .summary = "what must stay there; none: any hand",
     .reference = state::Reference::body},
};
constexpr state::ValueType kDwellValues[] = {
    state::yes_or_no("dwelt", "1 while it has stayed long enough"),
    state::yes_or_no("inside", "1 while it is there"),
    state::amount("time", "s", "for how long"),
};

}  // namespace

const AgentKind& dwell_kind() {
  static const AgentKind kKind{
      {"simulation.dwell", "A hand or a body stays at a place for a while", kDwellParameters, kDwellValues},
      make_dwell};
  return kKind;
}

}  // namespace mechane::agents
